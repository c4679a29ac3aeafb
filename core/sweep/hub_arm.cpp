#include "core/sweep/hub_arm.hpp"

#include <utility>

#include "core/base/error.hpp"
#include "core/base/random.hpp"
#include "core/motion/transit.hpp"

namespace sculpt {

void HubArm::resume(HubArmMemory memory, const Configuration& q, const PostureField* field) {
  memory_ = std::move(memory);
  q_ = q;
  field_ = field;
}

bool HubArm::enter(const PostureField& field) {
  const Vec3 hub_at = hub_cell(scene_.grid().n);
  const auto hub = field.at(hub_at);
  if (!hub) return false;
  const auto back = way_home();
  if (!back) return false;
  const std::vector<Configuration> path = find_transit(*hub);
  if (path.empty()) return false;
  move(path);
  memory_.way_home.assign(path.rbegin() + 1, path.rend());
  memory_.way_home.insert(memory_.way_home.end(), back->begin(), back->end());
  field_ = &field;
  memory_.at = hub_at;
  return true;
}

Followed HubArm::try_strokes(const Vec3& from, const std::vector<Stroke>& strokes) const {
  return follow(*field_, scene_.tool(), scene_.grid(), from, strokes);
}

std::size_t HubArm::commit(Followed followed, const std::vector<Stroke>& strokes) {
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
std::vector<Configuration> HubArm::find_transit(const Configuration& to) {
  Transit found = plan_transit(scene_, q_, to, mix(seed_, ++memory_.transits), watch_.stop);
  if (watch_.stop.stop_requested()) throw Cancelled{};
  return std::move(found.path);
}

/// From where the arm stands, above the material: over to the hub of the direction and from there as it came. Nothing
/// if something stands between it and the hub.
std::optional<std::vector<Configuration>> HubArm::way_home() const {
  if (field_ == nullptr) return std::vector<Configuration>{};
  const Vec3 hub = hub_cell(scene_.grid().n);
  const Followed over = try_strokes(memory_.at, {{hub, 0, 0, {}, {}}});
  if (memory_.at != hub && over.strokes == 0) return std::nullopt;
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
