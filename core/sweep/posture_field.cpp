#include "core/sweep/posture_field.hpp"

#include <algorithm>
#include <deque>

#include "core/cell/ik.hpp"
#include "core/sweep/posture.hpp"

namespace sculpt {
namespace {

/// Nodes beside each other may not differ by more in any joint (rad or m): else they are on two branches.
constexpr double longest_joint_step = 0.35;
constexpr double limit_margin = 0.002;  // rad or m: exact configurations differ from interpolated ones
constexpr double margin_voxels = 0.005;
/// Ball and shank, off their line by all that stray_of allows, stay within this of it, whatever their radii.
constexpr double tool_room_voxels = 0.5 - margin_voxels;
constexpr double headroom_cells = 2;  // beyond the grid, on the sides that the axis leans to: where the tool comes in

}  // namespace

PostureField::PostureField(const Scene& scene, const ToolView& view, const Configuration& start, const Watch& watch)
    : chain_(scene.chain()),
      grid_(scene.grid()),
      view_(view),
      start_(start),
      low_(Vec3::Constant(-0.5)),
      span_(Vec3::Constant(view.n) + headroom_cells * Vec3(view.lean.i, view.lean.j, view.lean.k)),
      nodes_(static_cast<std::size_t>(nodes) * nodes * nodes),
      bubble_(all_cells(), -1) {
  grow(start, watch);
  cover(scene, {0, 0, 0}, fine, parts, watch);
  close_upwards();
  find_roomy(scene);
}

void PostureField::refine(const Scene& scene, const Watch& watch) {
  const int last = fine - 1;
  for (int k = 0; k <= last; ++k)
    for (int j = 0; j <= last; ++j)
      for (int i = 0; i <= last; ++i)
        if (bubble_[index_of({i, j, k})] < 0) cover(scene, {i, j, k}, 1, 1, watch);
  close_upwards();
}

Vec3 PostureField::corner_cell(Voxel corner) const {
  return low_ + Vec3(corner.i, corner.j, corner.k).cwiseProduct(span_) / fine;
}

/// The farthest that the ball comes: where there is no headroom, to the centres of the last voxels.
Vec3 PostureField::last_cell() const {
  return Vec3(low_ + span_) - 0.5 * Vec3(1 - view_.lean.i, 1 - view_.lean.j, 1 - view_.lean.k);
}

/// The cell of the fine lattice that a place is in.
Voxel PostureField::corner_below(const Vec3& cell) const {
  const Vec3 at = (cell - low_).cwiseQuotient(span_) * fine;
  const auto whole = [](double x) { return std::clamp(static_cast<int>(x), 0, fine - 1); };
  return {whole(at.x()), whole(at.y()), whole(at.z())};
}

std::size_t PostureField::fine_cell(const Vec3& cell) const {
  return index_of(corner_below(cell));
}

/// From the middle of the top outwards, each node from a neighbour that has one.
void PostureField::grow(const Configuration& start, const Watch& watch) {
  struct Visit {
    Voxel node;
    Configuration guess;
  };
  std::deque<Visit> queue{{{cells / 2, cells / 2, cells}, start}};
  const Grid lattice{nodes, 1, Vec3::Zero()};
  while (!queue.empty()) {
    if (watch.stop.stop_requested()) throw Cancelled{};
    const Visit visit = std::move(queue.front());
    queue.pop_front();
    const Voxel at = visit.node;
    Configuration& node = nodes_[node_index(at.i, at.j, at.k)];
    if (node.size() > 0) continue;
    const auto q = solve_ik(chain_, {ball_m(corner_cell(at * parts)), view_.axis()}, visit.guess);
    if (!q) continue;
    const bool first = at == Voxel{cells / 2, cells / 2, cells};
    if (!first && (*q - visit.guess).cwiseAbs().maxCoeff() > longest_joint_step) continue;
    node = *q;
    for (Voxel step : face_steps)
      if (lattice.contains(at + step)) queue.push_back({at + step, node});
  }
}

bool PostureField::has_nodes(Voxel corner, int size) const {
  const Voxel low{corner.i / parts, corner.j / parts, corner.k / parts};
  const int last = std::max(1, size / parts);
  for (int k = 0; k <= last; ++k)
    for (int j = 0; j <= last; ++j)
      for (int i = 0; i <= last; ++i)
        if (nodes_[node_index(low.i + i, low.j + j, low.k + k)].size() == 0) return false;
  return true;
}

std::optional<Configuration> PostureField::corner_configuration(Voxel corner) const {
  if (corner.i % parts == 0 && corner.j % parts == 0 && corner.k % parts == 0)
    return nodes_[node_index(corner.i / parts, corner.j / parts, corner.k / parts)];
  return interpolate(corner_cell(corner));
}

/// A bubble that holds all corners in a cube of the fine lattice; those between nodes only in cubes smaller than a
/// cell.
std::optional<Bubble> PostureField::find_bubble(const Scene& scene, Voxel corner, int size) const {
  const auto centre = interpolate(corner_cell(corner) + span_ * (0.5 * size / fine));
  if (!centre) return std::nullopt;
  // Exact configurations differ a little from interpolated ones, and edges pass from one bubble to the next, so more is
  // asked for than is needed.
  constexpr double more = 1.08;
  std::vector<Configuration> steps;
  Configuration half = Configuration::Constant(chain_.dof(), 1e-6);
  const int stride = std::min(size, parts);
  for (int k = 0; k <= size; k += stride)
    for (int j = 0; j <= size; j += stride)
      for (int i = 0; i <= size; i += stride) {
        const auto q = corner_configuration(corner + Voxel{i, j, k});
        if (!q || !chain_.within_limits(*q, -limit_margin)) return std::nullopt;
        steps.push_back(*q - *centre);
        half = half.cwiseMax(more * steps.back().cwiseAbs());
      }
  Bubble bubble = scene.bubble(*centre, half);
  const bool all = std::all_of(steps.begin(), steps.end(),
                               [&](const Configuration& step) { return bubble.holds(*centre + (more - 1e-9) * step); });
  if (!all) return std::nullopt;
  return bubble;
}

/// Covers a cube of the fine lattice by one bubble if there is one, else by parts as small as `smallest`.
void PostureField::cover(const Scene& scene, Voxel corner, int size, int smallest, const Watch& watch) {
  if (watch.stop.stop_requested()) throw Cancelled{};
  if (has_nodes(corner, size)) {
    if (auto bubble = find_bubble(scene, corner, size)) {
      for (int k = 0; k < size; ++k)
        for (int j = 0; j < size; ++j)
          for (int i = 0; i < size; ++i) {
            const Voxel cell = corner + Voxel{i, j, k};
            // Positions are centres of voxels, or above: none is nearer to a side than half a voxel.
            const Vec3 first = corner_cell(cell).cwiseMax(0);
            const Vec3 last = corner_cell(cell + Voxel{1, 1, 1}).cwiseMin(last_cell());
            if ((first.array() <= last.array()).all() && !room_is_clear(scene, first, last, tool_room_voxels)) continue;
            bubble_[index_of(cell)] = static_cast<std::int32_t>(bubbles_.size());
          }
      bubbles_.push_back(std::move(*bubble));
      return;
    }
  }
  if (size == smallest) return;
  for (int child = 0; child < 8; ++child)
    cover(scene, corner + Voxel{child & 1, child >> 1 & 1, child >> 2} * (size / 2), size / 2, smallest, watch);
}

/// What can be come to can be left along the axis: a cell under one that may not be used may not be used either. A
/// tilted axis leads through cells that share an edge or a corner, so all those around it count.
void PostureField::close_upwards() {
  const Voxel lean = view_.lean;
  const auto usable_or_outside = [&](Voxel cell) {
    return std::max({cell.i, cell.j, cell.k}) >= fine || bubble_[index_of(cell)] >= 0;
  };
  for (int k = fine - 1; k >= 0; --k)
    for (int j = fine - 1; j >= 0; --j)
      for (int i = fine - 1; i >= 0; --i)
        for (int part = 1; part < 8; ++part) {
          const Voxel up{part & 1, part >> 1 & 1, part >> 2};
          if (up.i > lean.i || up.j > lean.j || up.k > lean.k) continue;
          if (!usable_or_outside(Voxel{i, j, k} + up)) bubble_[index_of({i, j, k})] = -1;
        }
  usable_ = static_cast<std::size_t>(std::count_if(bubble_.begin(), bubble_.end(), [](int id) { return id >= 0; }));
}

bool PostureField::room_is_clear(const Scene& scene, const Vec3& first, const Vec3& last, double room_voxels) const {
  const Vec3 a = ball_m(first), b = ball_m(last), reach = scene.tool().stickout_m * view_.axis();
  const double radius = room_voxels * grid_.voxel_m;
  const Vec3 low = a.cwiseMin(b).cwiseMin(a + reach).cwiseMin(b + reach) - Vec3::Constant(radius);
  const Vec3 high = a.cwiseMax(b).cwiseMax(a + reach).cwiseMax(b + reach) + Vec3::Constant(radius);
  return scene.room_is_clear(low, high);
}

/// The largest box of ball positions, as far as insets on all four sides go.
void PostureField::find_roomy(const Scene& scene) {
  for (int inset : {0, 1, 2, 4}) {
    const Vec3 first(inset, inset, 0), last = last_cell() - Vec3(inset, inset, 0);
    if (first.x() > last.x()) return;
    if (!room_is_clear(scene, first, last, 0.5 + tool_room_voxels)) continue;
    roomy_ = Eigen::AlignedBox3d(first, last);
    return;
  }
}

std::optional<Configuration> PostureField::interpolate(const Vec3& cell) const {
  const Vec3 at = (cell - low_).cwiseQuotient(span_) * cells;
  int base[3];
  double part[3];
  for (int axis = 0; axis < 3; ++axis) {
    base[axis] = std::clamp(static_cast<int>(at[axis]), 0, cells - 1);
    part[axis] = at[axis] - base[axis];
  }
  Configuration sum = Configuration::Zero(chain_.dof());
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const Configuration& node = nodes_[node_index(base[0] + i, base[1] + j, base[2] + k)];
    if (node.size() == 0) return std::nullopt;
    sum += (i ? part[0] : 1 - part[0]) * (j ? part[1] : 1 - part[1]) * (k ? part[2] : 1 - part[2]) * node;
  }
  return find_posture(chain_, ball_m(cell), view_.axis(), sum);
}

std::optional<Configuration> PostureField::at(const Vec3& cell) const {
  if (!usable(cell)) return std::nullopt;
  return interpolate(cell);
}

bool PostureField::links_are_free(const Vec3& from_cell, const Configuration& from, const Vec3& to_cell,
                                  const Configuration& to) const {
  constexpr int splits = 12;
  return line_is_usable(from_cell, to_cell, splits) && in_bubbles(from_cell, from, to_cell, to, splits);
}

/// Two cells that share a face are a box together, so a line between them stays in them; others are halved. What is
/// left where a line passes an edge of the lattice needs all cells around it.
bool PostureField::line_is_usable(const Vec3& from_cell, const Vec3& to_cell, int splits) const {
  const Voxel from = corner_below(from_cell), to = corner_below(to_cell);
  if (bubble_[index_of(from)] < 0 || bubble_[index_of(to)] < 0) return false;
  if (l1(from, to) <= 1) return true;
  if (splits > 0) {
    const Vec3 middle = (from_cell + to_cell) / 2;
    return line_is_usable(from_cell, middle, splits - 1) && line_is_usable(middle, to_cell, splits - 1);
  }
  for (int k = std::min(from.k, to.k); k <= std::max(from.k, to.k); ++k)
    for (int j = std::min(from.j, to.j); j <= std::max(from.j, to.j); ++j)
      for (int i = std::min(from.i, to.i); i <= std::max(from.i, to.i); ++i)
        if (bubble_[index_of({i, j, k})] < 0) return false;
  return true;
}

bool PostureField::in_bubbles(const Vec3& from_cell, const Configuration& from, const Vec3& to_cell,
                              const Configuration& to, int splits) const {
  for (const Vec3& cell : {from_cell, to_cell}) {
    const std::int32_t id = bubble_[fine_cell(cell)];
    if (id < 0) continue;
    const Bubble& bubble = bubbles_[static_cast<std::size_t>(id)];
    if (bubble.holds(from) && bubble.holds(to)) return true;
  }
  if (splits == 0) return false;
  const Vec3 middle_cell = (from_cell + to_cell) / 2;
  const Configuration middle = (from + to) / 2;
  return in_bubbles(from_cell, from, middle_cell, middle, splits - 1) &&
         in_bubbles(middle_cell, middle, to_cell, to, splits - 1);
}

}  // namespace sculpt
