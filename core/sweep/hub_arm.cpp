#include "core/sweep/hub_arm.hpp"

#include <utility>

#include "core/base/error.hpp"
#include "core/base/random.hpp"
#include "core/motion/transit.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

void HubArm::resume(HubArmMemory memory, const Configuration& q, const PostureField* field) {
  memory_ = std::move(memory);
  q_ = q;
  field_ = field;
}

bool HubArm::enter(const PostureField& field) {
  std::optional<Entry> entry = find_entry(field);
  if (entry) enter(std::move(*entry));
  return entry.has_value();
}

std::optional<HubArm::Entry> HubArm::find_entry(const PostureField& field) const {
  const auto hub = field.at(ToolView::place(field.hub()));
  if (!hub) return std::nullopt;
  auto back = way_home();
  if (!back) return std::nullopt;
  Entry entry{&field, find_way(*back, *hub), std::move(*back)};
  if (entry.path.empty()) return std::nullopt;
  return entry;
}

void HubArm::enter(Entry entry) {
  move(entry.path);
  memory_.way_home.assign(entry.path.rbegin() + 1, entry.path.rend());
  memory_.way_home.insert(memory_.way_home.end(), entry.back.begin(), entry.back.end());
  ++memory_.transits;
  field_ = entry.field;
  memory_.at = ToolView::place(field_->hub());
}

/// From where it stands; empty if none was found. Where no edge leads there it draws back to a place on its way home,
/// has the stock turned there and comes forward again, or searches.
std::vector<Configuration> HubArm::find_way(const std::vector<Configuration>& back, const Configuration& to) const {
  const auto is_free = [this](const Configuration& from, const Configuration& there) {
    return scene_.certify(from, there) == Contact::none;
  };
  if (is_free(q_, to)) return {q_, to};
  for (auto place = back.begin(); turn_ && place != back.end(); ++place) {
    Configuration before = *place, after = *place;
    before[*turn_] = q_[*turn_];
    after[*turn_] = to[*turn_];
    if (is_free(before, after) && is_free(q_, before) && is_free(after, to)) return {q_, before, after, to};
  }
  return find_transit(to);
}

FollowedStrokes HubArm::try_strokes(const PostureField& field, const Vec3& from,
                                    const std::vector<Stroke>& strokes) const {
  return follow(field, scene_.tool(), scene_.grid(), from, strokes);
}

std::size_t HubArm::commit(FollowedStrokes followed, const std::vector<Stroke>& strokes) {
  for (const Keyframe& keyframe : followed.keyframes)
    if (keyframe.cut) removed_ += static_cast<std::uint64_t>(run_length(keyframe));
  if (!followed.keyframes.empty()) q_ = followed.keyframes.back().q;
  if (followed.strokes > 0) memory_.at = strokes[followed.strokes - 1].to;
  emit(std::move(followed.keyframes));
  return followed.strokes;
}

void HubArm::go_home() {
  if (const std::vector<Configuration> path = find_transit(home_); !path.empty()) return move(path);
  const auto way = way_home();
  if (!way)
    throw InputError("no_transit", "the arm finds no way home from above the stock: keep what stands beside it lower");
  move(*way);
}

/// From where it stands; empty if none was found.
std::vector<Configuration> HubArm::find_transit(const Configuration& to) const {
  Transit found = plan_transit(scene_, q_, to, mix(seed_, memory_.transits + 1), watch_.stop);
  if (watch_.stop.stop_requested()) throw Cancelled{};
  return std::move(found.path);
}

/// From where the arm stands, above the material: over to the hub of the direction and from there as it came. Nothing
/// if something stands between it and the hub.
std::optional<std::vector<Configuration>> HubArm::way_home() const {
  if (field_ == nullptr) return std::vector<Configuration>{};
  const Vec3 hub = ToolView::place(field_->hub());
  std::vector<Stroke> strokes;
  for (const Vec3& place : field_->way_over(memory_.at, hub)) strokes.push_back({place, 0, 0, {}, {}});
  const FollowedStrokes over = try_strokes(*field_, memory_.at, strokes);
  if (memory_.at != hub && over.strokes < strokes.size()) return std::nullopt;
  std::vector<Configuration> way;
  for (const Keyframe& keyframe : over.keyframes) way.push_back(keyframe.q);
  way.insert(way.end(), memory_.way_home.begin(), memory_.way_home.end());
  return way;
}

void HubArm::move(const std::vector<Configuration>& way) {
  std::vector<Keyframe> keyframes;
  for (const Configuration& q : way) {
    if (q == q_) continue;
    keyframes.push_back({q, false, {}, {}});
    q_ = q;
  }
  emit(std::move(keyframes));
}

void HubArm::emit(std::vector<Keyframe> keyframes) const {
  if (!keyframes.empty()) emit_(std::move(keyframes));
}

}  // namespace sculpt
