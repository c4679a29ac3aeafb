#include "core/mill/drive/mill_arm.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/random.hpp"
#include "core/cell/link_tree.hpp"
#include "core/motion/transit.hpp"
#include "core/trajectory/milling/quanta_point.hpp"

namespace sculpt {
namespace {

constexpr int search_steps = 400;
constexpr double search_range = 0.7;

/// Those that move the stock and not the tool: on the way from the stock to the tool they come before the first link
/// that stands still.
std::vector<int> stock_coordinates(const Chain& chain) {
  std::vector<int> coordinates;
  for (int c = 0; c < chain.dof(); ++c)
    if (carries(chain.robot(), chain.joints()[static_cast<std::size_t>(c)], chain.stock_link()))
      coordinates.push_back(c);
  return coordinates;
}

}  // namespace

/// Straight; or back to a place on the way home, where the stock is turned, and forward from there; or home and by a
/// way that was found before, for this direction or for another one; or a search, once.
std::vector<Configuration> MillArm::find_way(const Configuration& to, int direction) {
  const Scene& scene = held_->carrying();
  if (is_free(q_, to)) return {q_, to};
  const std::vector<int> turning = stock_coordinates(scene.chain());
  if (std::vector<Configuration> way = way_by_turning(to, turning); !way.empty()) return way;
  if (const auto known = known_.ways.find(direction); known != known_.ways.end())
    if (std::vector<Configuration> way = way_by_home(known->second, to); !way.empty()) return way;
  if (std::vector<Configuration> way = way_as_elsewhere(to, turning); !way.empty()) return way;
  if (!known_.searched.insert(direction).second) return {};
  Transit found =
      plan_transit(scene, q_, to, mix(run_.seed, known_.transits + 1), run_.watch.stop, {search_steps, search_range});
  if (run_.watch.stop.stop_requested()) throw Cancelled{};
  return std::move(found.path);
}

/// Back to a place on the way home, where the stock is turned, and forward from there; nothing if that is not free.
std::vector<Configuration> MillArm::way_by_turning(const Configuration& to, const std::vector<int>& turning) const {
  for (std::size_t place = 0; place < way_home_.size(); ++place) {
    Configuration before = way_home_[place], after = before;
    for (const int coordinate : turning) {
      before[coordinate] = q_[coordinate];
      after[coordinate] = to[coordinate];
    }
    if (is_free(q_, before) && is_free(before, after) && is_free(after, to)) return {q_, before, after, to};
    // Else all the way back as it came, and forward from there.
    if (place + 1 == way_home_.size() && is_free(way_home_[place], after) && is_free(after, to)) {
      std::vector<Configuration> way{q_};
      way.insert(way.end(), way_home_.begin(), way_home_.end());
      way.insert(way.end(), {after, to});
      return way;
    }
  }
  return {};
}

/// As into another direction, with the stock turned; nothing if that is not free.
std::vector<Configuration> MillArm::way_as_elsewhere(const Configuration& to, const std::vector<int>& turning) const {
  for (const auto& [other, known] : known_.ways) {
    std::vector<Configuration> places = known;
    for (Configuration& place : places)
      for (const int coordinate : turning) place[coordinate] = to[coordinate];
    if (std::vector<Configuration> way = way_by_home(places, to); !way.empty()) return way;
  }
  return {};
}

/// Home, whose edges are free the more is cut, and on by these places; nothing if that is not free.
std::vector<Configuration> MillArm::way_by_home(const std::vector<Configuration>& places,
                                                const Configuration& to) const {
  std::vector<Configuration> way{q_};
  way.insert(way.end(), way_home_.begin(), way_home_.end());
  const std::size_t home = std::max<std::size_t>(way_home_.size(), 1);
  way.insert(way.end(), places.begin(), places.end());
  way.push_back(to);
  bool free = is_free(way[0], way[1]);
  for (std::size_t at = home; free && at + 1 < way.size(); ++at) free = is_free(way[at], way[at + 1]);
  return free ? way : std::vector<Configuration>();
}

bool MillArm::is_free(const Configuration& from, const Configuration& to) const {
  return from == to || held_->carrying().certify(from, to) == Contact::none;
}

/// Takes the arm to its end.
std::vector<Keyframe> MillArm::moves(const std::vector<Configuration>& way) {
  std::vector<Keyframe> keyframes;
  for (const Configuration& q : way) {
    if (q == q_) continue;
    keyframes.push_back({q, false, {}, {}, MillStep{}});
    q_ = q;
  }
  return keyframes;
}

void MillArm::move(const std::vector<Configuration>& way) {
  if (std::vector<Keyframe> keyframes = moves(way); !keyframes.empty()) emit_(std::move(keyframes));
}

/// The direction that was entered last, if nothing was done there.
void MillArm::drop_entry() {
  if (!entry_) return;
  q_ = entry_->q;
  way_home_ = std::move(entry_->way_home);
  entry_.reset();
  tip_.reset();
  field_ = nullptr;
  direction_ = -1;
}

/// From outside the stock.
void MillArm::go_home() {
  drop_entry();
  if (q_ == home_) return;
  ++known_.transits;
  std::vector<Configuration> way = find_way(home_, -1);
  if (way.empty())
    throw InputError("no_transit",
                     "the arm finds no way out of a direction of the tool: keep what stands beside the stock lower");
  move(way);
  known_.searched.erase(-1);
  way_home_.clear();
  tip_.reset();
  field_ = nullptr;
  direction_ = -1;
}

void MillArm::take_tool(int number, const HeldTool& held) {
  const bool is_first = held_ == nullptr;
  if (!is_first) {
    go_home();
    go_over(change_);
    emit_({Keyframe{q_, false, {}, {}, MillStep{{}, -1, number, 0}}});
  }
  held_ = &held;
  if (!is_first) go_over(home_);  // with the other tool no edge of the way there is known to be free
}

void MillArm::go_on(const HeldTool& held, MillArmMemory known) {
  held_ = &held;
  known_ = std::move(known);
}

void MillArm::go_over(const Configuration& to) {
  std::vector<Configuration> way{q_, to};
  if (!is_free(q_, to))
    way = plan_transit(held_->carrying(), q_, to, mix(run_.seed, ++known_.transits), run_.watch.stop,
                       {search_steps, search_range})
              .path;
  if (run_.watch.stop.stop_requested()) throw Cancelled{};
  if (way.empty())
    throw InputError("no_transit",
                     "the arm finds no way between home and where tools are changed: set tool_change in the cell file "
                     "nearer to home");
  move(way);
}

bool MillArm::hold(const PostureField& field, int direction, const Vec3& tip) {
  const Vec3 cell = HeldTool::cell_of(field, held_->around(), tip);
  if (!field.usable(cell)) return false;
  // The very configuration that following begins with.
  const FollowedMill there = follow(*held_, field, direction, tip, {{tip, false, 1e-3}});
  if (there.keyframes.empty()) return false;
  Keyframe last = there.keyframes.back();
  drop_entry();
  ++known_.transits;
  std::vector<Configuration> way = find_way(last.q, direction);
  if (way.empty()) return false;
  std::vector<Configuration> back(way.rbegin() + 1, way.rend());
  back.insert(back.end(), way_home_.begin(), way_home_.end());
  // Not beyond the first time at home.
  if (const auto rest = std::ranges::find(back, home_); rest != back.end()) back.erase(rest + 1, back.end());
  entry_ = Entry{{}, q_, std::exchange(way_home_, std::move(back))};
  known_.ways[direction].assign(way_home_.rbegin(), way_home_.rend());
  known_.ways[direction].push_back(last.q);
  way.pop_back();
  entry_->keyframes = moves(way);
  entry_->keyframes.push_back(last);
  q_ = last.q;
  field_ = &field;
  direction_ = direction;
  tip_ = tip;
  return true;
}

FollowedMill MillArm::try_strokes(const std::vector<MillStroke>& strokes) const {
  return follow(*held_, *field_, direction_, *tip_, strokes);
}

void MillArm::commit(FollowedMill followed) {
  if (followed.keyframes.empty()) return;
  if (entry_) emit_(std::move(entry_->keyframes));
  entry_.reset();
  const Keyframe& last = followed.keyframes.back();
  q_ = last.q;
  tip_ = point_of(last.mill->tip);
  emit_(std::move(followed.keyframes));
}

}  // namespace sculpt
