#include "core/sweep/field/posture_field.hpp"

#include <algorithm>
#include <deque>
#include <map>

#include "core/collision/margins.hpp"
#include "core/sweep/field/posture.hpp"

namespace sculpt {
namespace {

/// How far the tool may be off a wide path, and beside that the room that it takes itself.
constexpr double wide_room_voxels = 0.5 + (0.5 - tool_margin_voxels);

}  // namespace

PostureField::PostureField(const Scene& scene, const ToolView& view, const PostureLattice::Start& start,
                           const Helpers& helpers, const Watch& watch)
    : lattice_(scene.chain(), scene.grid(), view, start, watch),
      cover_({scene, scene.full_stock(), lattice_, helpers, watch}) {
  find_roomy(scene);
  find_hub();
}

PostureField::PostureField(const Scene& scene, const ToolView& view, Record record, const Watch& watch)
    : lattice_(scene.chain(), scene.grid(), view, record.start, watch),
      cover_(std::move(record.cover)),
      roomy_(record.roomy) {
  find_hub();
}

PostureField::PostureField(const PostureField& other, const Scene& scene, const Body& stock, const VoxelSet& wanted,
                           const Helpers& helpers, const Watch& watch)
    : PostureField(other) {
  cover_.extend({scene, stock, lattice_, helpers, watch}, wanted);
  find_hub();
}

PostureField::PostureField(const PostureField& other, const ToolView& view, const Configuration& turn)
    : PostureField(other) {
  lattice_.turn(view, turn);
  cover_.turn(turn);
}

void PostureField::refine(const Scene& scene, const Body& stock, const Helpers& helpers, const Watch& watch) {
  cover_.refine({scene, stock, lattice_, helpers, watch});
  find_hub();
}

/// The node that the lattice grew from, or the nearest.
void PostureField::find_hub() {
  const PostureLattice::Start& from = lattice_.origin();
  std::optional<int> nearest;
  for (int j = 0; j <= PostureLattice::cells; ++j)
    for (int i = 0; i <= PostureLattice::cells; ++i) {
      const int far = (i - from.i) * (i - from.i) + (j - from.j) * (j - from.j);
      const Voxel hub = PostureLattice::hub_of(view().n, {{}, i, j});
      if ((nearest && far >= *nearest) || !usable(ToolView::place(hub))) continue;
      nearest = far;
      hub_ = hub;
    }
  if (!nearest) hub_ = PostureLattice::hub_of(view().n, from);
}

/// The largest box of ball positions, as far as insets on all four sides go.
void PostureField::find_roomy(const Scene& scene) {
  for (int inset : {0, 1, 2, 4}) {
    const Vec3 first(inset, inset, 0), last = lattice_.last_cell() - Vec3(inset, inset, 0);
    if (first.x() > last.x()) return;
    if (!tool_has_room(scene, lattice_, first, last, wide_room_voxels)) continue;
    roomy_ = Eigen::AlignedBox3d(first, last);
    return;
  }
}

std::optional<Configuration> PostureField::at(const Vec3& cell) const {
  if (!usable(cell)) return std::nullopt;
  return find_posture(chain(), ball_m(cell), view().axis(), guess(cell));
}

bool PostureField::links_are_free(const Vec3& from_cell, const Configuration& from, const Vec3& to_cell,
                                  const Configuration& to, int& held) const {
  constexpr int splits = 12;
  int held_now = held;
  if (!line_is_usable(from_cell, to_cell, splits) || !in_bubbles(from_cell, from, to_cell, to, held_now, splits))
    return false;
  held = held_now;
  return true;
}

std::vector<Vec3> PostureField::way_over(const Vec3& from_cell, const Vec3& to_cell) const {
  constexpr int splits = 12;
  const Voxel from = part(from_cell), to = part(to_cell);
  if (from.k != to.k || line_is_usable(from_cell, to_cell, splits)) return {to_cell};
  // Breadth first, from the end back to the beginning.
  std::map<Voxel, Voxel> next{{to, to}};
  for (std::deque<Voxel> queue{to}; !queue.empty() && next.count(from) == 0; queue.pop_front())
    for (const Voxel step : face_steps) {
      const Voxel beside = queue.front() + step;
      if (step.k != 0 || std::min(beside.i, beside.j) < 0 || std::max(beside.i, beside.j) >= PostureLattice::fine)
        continue;
      if (usable_part(beside) && next.emplace(beside, queue.front()).second) queue.push_back(beside);
    }
  if (next.count(from) == 0) return {to_cell};
  std::vector<Vec3> places;
  for (Voxel at = from; at != to; at = next.at(at)) {
    Vec3 place = lattice_.middle_cell(at, 1);
    place.z() = from_cell.z();
    places.push_back(place);
  }
  places.push_back(to_cell);
  std::vector<Vec3> way;
  for (Vec3 at = from_cell; !places.empty(); at = way.back()) {
    std::size_t straight = places.size() - 1;
    while (straight > 0 && !line_is_usable(at, places[straight], splits)) --straight;
    way.push_back(places[straight]);
    places.erase(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(straight) + 1);
  }
  return way;
}

/// Two cells that share a face are a box together, so a line between them stays in them; others are halved. What is
/// left where a line passes an edge of the lattice needs all cells around it.
bool PostureField::line_is_usable(const Vec3& from_cell, const Vec3& to_cell, int splits) const {
  const Voxel from = part(from_cell), to = part(to_cell);
  if (!usable_part(from) || !usable_part(to)) return false;
  if (l1(from, to) <= 1) return true;
  if (splits > 0) {
    const Vec3 middle = (from_cell + to_cell) / 2;
    return line_is_usable(from_cell, middle, splits - 1) && line_is_usable(middle, to_cell, splits - 1);
  }
  for (int k = std::min(from.k, to.k); k <= std::max(from.k, to.k); ++k)
    for (int j = std::min(from.j, to.j); j <= std::max(from.j, to.j); ++j)
      for (int i = std::min(from.i, to.i); i <= std::max(from.i, to.i); ++i)
        if (!usable_part({i, j, k})) return false;
  return true;
}

bool PostureField::in_bubbles(const Vec3& from_cell, const Configuration& from, const Vec3& to_cell,
                              const Configuration& to, int& held, int splits) const {
  for (const Vec3& cell : {from_cell, to_cell}) {
    const std::int32_t id = cover_.bubble_of(part(cell));
    if (id < 0) continue;
    const Bubble& bubble = cover_.bubble(id);
    if (!(id == held || bubble.holds(from)) || !bubble.holds(to)) continue;
    held = id;
    return true;
  }
  if (splits == 0) return false;
  const Vec3 middle_cell = (from_cell + to_cell) / 2;
  const Configuration middle = (from + to) / 2;
  return in_bubbles(from_cell, from, middle_cell, middle, held, splits - 1) &&
         in_bubbles(middle_cell, middle, to_cell, to, held, splits - 1);
}

}  // namespace sculpt
