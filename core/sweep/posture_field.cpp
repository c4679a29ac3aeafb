#include "core/sweep/posture_field.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "core/base/helpers.hpp"
#include "core/cell/ik.hpp"
#include "core/collision/margins.hpp"
#include "core/sweep/posture.hpp"
#include "core/sweep/posture_lanes.hpp"

namespace sculpt {
namespace {

/// Nodes beside each other may not differ by more in any joint (rad or m): else they are on two branches.
constexpr double max_joint_step = 0.35;
constexpr double max_midpoint_deviation = 0.02;  // rad or m: by which a node may be off the middle of two that are beside it
constexpr int node_steps = 3;       // from one node to the next
constexpr int between_steps = 2;    // from what is interpolated between them
constexpr double close_m = 1e-6;
constexpr double limit_margin = 0.002;  // rad or m: exact configurations differ from interpolated ones
/// Ball and shank, off their line by all that path_tolerance allows, stay within this of it, whatever their radii.
constexpr double tool_room_voxels = 0.5 - tool_margin_voxels;
constexpr double headroom_cells = 2;  // beyond the grid, on the sides that the axis leans to: where the tool comes in
constexpr int largest = 8;            // cubes of the fine lattice that are tried first
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

}  // namespace

PostureField::PostureField(const Scene& scene, const ToolView& view, const Configuration& start, const Helpers& helpers,
                           const Watch& watch)
    : chain_(scene.chain()),
      grid_(scene.grid()),
      view_(view),
      lanes_(chain_, view.axis()),
      start_(start),
      low_(Vec3::Constant(-0.5)),
      span_(Vec3::Constant(view.n) + headroom_cells * Vec3(view.lean.i, view.lean.j, view.lean.k)),
      parts_per_cell_(fine * span_.cwiseInverse()),
      nodes_(Eigen::MatrixXd::Constant(chain_.dof(), nodes * nodes * nodes, nowhere)),
      covered_(all_cells(), -1) {
  grow(start, watch);
  around_ = find_surroundings(scene);
  std::vector<Cube> cubes;
  for (int k = 0; k < fine; k += largest)
    for (int j = 0; j < fine; j += largest)
      for (int i = 0; i < fine; i += largest) cubes.push_back({{i, j, k}, largest, around_});
  cover(scene, cubes, parts, helpers, watch);
  find_roomy(scene);
}

PostureField::PostureField(const PostureField& other, const ToolView& view, const Configuration& turn)
    : PostureField(other) {
  view_ = view;
  lanes_ = PostureLanes(chain_, view.axis());
  start_ += turn;
  nodes_.colwise() += turn;
  for (Bubble& bubble : bubbles_) bubble.shift(turn);
  around_.box = around_.box.shifted(turn);
  holes_.clear();
}

void PostureField::refine(const Scene& scene, const Helpers& helpers, const Watch& watch) {
  cover(scene, std::exchange(holes_, {}), 1, helpers, watch);
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
  const Vec3 at = (cell - low_).cwiseProduct(parts_per_cell_);
  const auto whole = [](double x) { return std::clamp(static_cast<int>(x), 0, fine - 1); };
  return {whole(at.x()), whole(at.y()), whole(at.z())};
}

std::size_t PostureField::fine_cell(const Vec3& cell) const {
  return index_of(corner_below(cell));
}

/// Every other node from the one before, from the middle of the top outwards; those between them by interpolation,
/// which is as good as exact; what is missing then from neighbours.
void PostureField::grow(const Configuration& start, const Watch& watch) {
  spread({{first_node, start}}, 2, watch);
  fill_between();
  std::deque<Visit> beside;
  for_each_node([&](Voxel node) {
    if (!has_node(node)) return;
    for (const Voxel step : face_steps)
      if (is_node(node + step) && !has_node(node + step)) beside.push_back({node + step, node_at(node)});
  });
  spread(std::move(beside), 1, watch);
}

/// Each node from one that is `stride` away and has a configuration.
void PostureField::spread(std::deque<Visit> queue, int stride, const Watch& watch) {
  const NullSpaceGoal to_the_middle{(chain_.lower() + chain_.upper()) / 2, 0.05};
  while (!queue.empty()) {
    if (watch.stop.stop_requested()) throw Cancelled{};
    std::vector<Visit> visits, again;
    PostureBatch batch;
    while (!queue.empty() && visits.size() < lane_count) {
      Visit visit = std::move(queue.front());
      queue.pop_front();
      if (has_node(visit.node)) continue;
      if (std::any_of(visits.begin(), visits.end(), [&](const Visit& v) { return v.node == visit.node; })) {
        again.push_back(std::move(visit));
        continue;
      }
      batch.set(static_cast<int>(visits.size()), ball_m(corner_cell(visit.node * parts)), visit.guess);
      visits.push_back(std::move(visit));
    }
    queue.insert(queue.end(), again.begin(), again.end());
    lanes_.solve(batch, node_steps, &to_the_middle);
    for (std::size_t at = 0; at < visits.size(); ++at) {
      const auto& [node, guess] = visits[at];
      const int lane = static_cast<int>(at);
      std::optional<Configuration> q;
      if (batch.ball_off_m[at] < close_m) {
        q = batch.q.get(lane, chain_.dof());
      } else {  // it keeps off joint limits
        q = solve_ik(chain_, {ball_m(corner_cell(node * parts)), view_.axis()}, guess);
      }
      if (!q || (node != first_node && (*q - guess).cwiseAbs().maxCoeff() > stride * max_joint_step)) continue;
      node_at(node) = *q;
      for (const Voxel step : face_steps)
        if (is_node(node + step * stride)) queue.push_back({node + step * stride, *q});
    }
  }
}

/// The nodes between those, along x, then y, then z.
void PostureField::fill_between() {
  for (int axis = 0; axis < 3; ++axis)
    for_each_node([&](Voxel node) {
      const int last_odd = node.k % 2 ? 2 : node.j % 2 ? 1 : node.i % 2 ? 0 : -1;
      if (axis != last_odd) return;
      if (const auto q = find_between(node, {axis == 0, axis == 1, axis == 2})) node_at(node) = *q;
    });
}

/// From the nodes beside it and those beyond them, by Lagrange's polynomial through the four, three at the rim. Nothing
/// where that differs much from the straight line between the two beside it, or these are on two branches.
std::optional<Configuration> PostureField::find_between(Voxel node, Voxel along) const {
  if (!has_node(node - along) || !has_node(node + along)) return std::nullopt;
  const Configuration low = node_at(node - along), high = node_at(node + along), middle = (low + high) / 2;
  const Voxel below = node - along * 3, above = node + along * 3;
  const bool has_below = is_node(below) && has_node(below), has_above = is_node(above) && has_node(above);
  Configuration q = middle;
  if (has_below && has_above)
    q = (9 * (low + high) - node_at(below) - node_at(above)) / 16;
  else if (has_below)
    q = (3 * high + 6 * low - node_at(below)) / 8;
  else if (has_above)
    q = (3 * low + 6 * high - node_at(above)) / 8;
  else
    return std::nullopt;
  const bool one_branch = (high - low).cwiseAbs().maxCoeff() <= 2 * max_joint_step;
  const bool straight = (q - middle).cwiseAbs().maxCoeff() <= max_midpoint_deviation;
  if (!one_branch || !straight || !chain_.within_limits(q)) return std::nullopt;
  return q;
}

bool PostureField::has_nodes(Voxel corner, int size) const {
  const Voxel low{corner.i / parts, corner.j / parts, corner.k / parts};
  const int last = std::max(1, size / parts);
  for (int k = 0; k <= last; ++k)
    for (int j = 0; j <= last; ++j)
      for (int i = 0; i <= last; ++i)
        if (!has_node(low + Voxel{i, j, k})) return false;
  return true;
}

/// The configurations at its corners, and in larger cubes than a cell at all nodes; none where one is missing.
std::vector<Configuration> PostureField::find_corners(const Cube& cube) const {
  std::vector<Configuration> corners;
  PostureBatch between;
  const int stride = std::min(cube.size, parts), along = cube.size / stride + 1;
  corners.reserve(static_cast<std::size_t>(along * along * along));
  for (int k = 0; k <= cube.size; k += stride)
    for (int j = 0; j <= cube.size; j += stride)
      for (int i = 0; i <= cube.size; i += stride) {
        const Voxel corner = cube.corner + Voxel{i, j, k};
        const Vec3 cell = corner_cell(corner);
        if (cube.size < parts) between.set(static_cast<int>(corners.size()), ball_m(cell), guess(cell));
        corners.emplace_back(node_at({corner.i / parts, corner.j / parts, corner.k / parts}));
      }
  if (cube.size < parts) {
    lanes_.solve(between, between_steps);
    for (int lane = 0; lane < 8; ++lane) {
      if (!(between.ball_off_m[static_cast<std::size_t>(lane)] < close_m)) return {};
      corners[static_cast<std::size_t>(lane)] = between.q.get(lane, chain_.dof());
    }
  }
  return corners;
}

/// All that the nodes lie in, with something to spare.
PostureField::Surroundings PostureField::find_surroundings(const Scene& scene) const {
  JointBox box{Configuration::Constant(chain_.dof(), std::numeric_limits<double>::max()),
               Configuration::Constant(chain_.dof(), std::numeric_limits<double>::lowest())};
  for (const auto& node : nodes_.colwise()) {
    if (std::isnan(node[0])) continue;
    box.low = box.low.cwiseMin(node);
    box.high = box.high.cwiseMax(node);
  }
  if ((box.low.array() > box.high.array()).any()) return {};
  const Configuration spare = Configuration::Constant(chain_.dof(), 1e-3) + 0.1 * (box.high - box.low);
  box = {box.low - spare, box.high + spare};
  return {box, scene.pairs_in(box)};
}

/// What a bubble for a cube must hold: a little more than all corners in it, those between nodes only in cubes smaller
/// than a cell.
struct PostureField::Wanted {
  Configuration centre;
  std::vector<Configuration> corners;  ///< none if one is missing or near a limit
  JointBox box;                        ///< around them

  bool held_by(const Bubble& bubble) const {
    return std::ranges::all_of(corners, [&](const Configuration& q) { return bubble.holds(q); });
  }
};

PostureField::Wanted PostureField::find_wanted(const Cube& cube) const {
  // Exact configurations differ a little from interpolated ones, and edges pass from one bubble to the next, so more is
  // asked for than is needed.
  constexpr double more = 1.08;
  Wanted wanted{guess(corner_cell(cube.corner) + span_ * (0.5 * cube.size / fine)), find_corners(cube), {}};
  if (wanted.corners.empty()) return wanted;
  JointBox hull{wanted.corners.front(), wanted.corners.front()};
  for (const Configuration& q : wanted.corners) hull = {hull.low.cwiseMin(q), hull.high.cwiseMax(q)};
  if (!chain_.within_limits(hull.low, -limit_margin) || !chain_.within_limits(hull.high, -limit_margin)) return {};
  for (Configuration& q : wanted.corners) q = wanted.centre + more * (q - wanted.centre);
  const Configuration half = more * hull.reach_from(wanted.centre) + Configuration::Constant(chain_.dof(), 1e-6);
  wanted.box = {wanted.centre - half, wanted.centre + half};
  return wanted;
}

/// A bubble in the box of what is wanted; empty if there is none. The cube's surroundings become those of the bubble.
Bubble PostureField::find_bubble(const Scene& scene, const Wanted& wanted, Cube& cube) const {
  if (!cube.around.box.holds(wanted.box)) cube.around = around_;
  if (!cube.around.box.holds(wanted.box)) return {};
  cube.around.box = wanted.box;
  return scene.bubble(wanted.centre, wanted.box, cube.around.pairs);
}

/// Bubbles and the usable cells that each of them is for.
struct PostureField::Cover {
  std::vector<std::pair<Bubble, std::vector<Voxel>>> bubbles;
  std::vector<Cube> holes;
};

void PostureField::cover(const Scene& scene, const std::vector<Cube>& cubes, int smallest, const Helpers& helpers,
                         const Watch& watch) {
  std::vector<Cover> found(cubes.size());
  helpers.for_each_index(cubes.size(),
                         [&](std::size_t at) { cover(scene, cubes[at], smallest, {}, false, found[at], watch); });
  for (Cover& one : found) {
    for (auto& [bubble, places] : one.bubbles) {
      if (places.empty()) continue;
      for (Voxel place : places) covered_[index_of(place)] = static_cast<std::int32_t>(bubbles_.size());
      bubbles_.push_back(std::move(bubble));
    }
    holes_.insert(holes_.end(), one.holes.begin(), one.holes.end());
  }
  close_upwards();
}

/// Covers a cube by one bubble if there is one, else by parts as small as `smallest`. `tried`: the last of the bubbles
/// found that did not hold all of a cube around it. `room`: for the tool is known.
void PostureField::cover(const Scene& scene, Cube cube, int smallest, std::optional<std::size_t> tried, bool room,
                         Cover& found, const Watch& watch) const {
  if (watch.stop.stop_requested()) throw Cancelled{};
  const bool has_all = has_nodes(cube.corner, cube.size);
  if (cube.size <= parts && !has_all) return;
  room = room || room_is_clear(scene, cube);
  if (const Wanted wanted = has_all ? find_wanted(cube) : Wanted{}; !wanted.corners.empty()) {
    bool held = tried && wanted.held_by(found.bubbles[*tried].first);
    if (!held) {
      if (Bubble bubble = find_bubble(scene, wanted, cube); !bubble.empty()) {
        held = wanted.held_by(bubble);
        tried = found.bubbles.size();
        found.bubbles.emplace_back(std::move(bubble), std::vector<Voxel>{});
      }
    }
    if (held) {
      std::vector<Voxel>& places = found.bubbles[*tried].second;
      for (int k = 0; k < cube.size; ++k)
        for (int j = 0; j < cube.size; ++j)
          for (int i = 0; i < cube.size; ++i) {
            const Voxel place = cube.corner + Voxel{i, j, k};
            if (room || room_is_clear(scene, {place, 1, {}})) places.push_back(place);
          }
      return;
    }
  }
  if (cube.size == smallest) {
    found.holes.push_back(std::move(cube));
    return;
  }
  const int half = cube.size / 2;
  for (int child = 0; child < 8; ++child)
    cover(scene, {cube.corner + Voxel{child & 1, child >> 1 & 1, child >> 2} * half, half, cube.around}, smallest,
          tried, room, found, watch);
}

/// For all ball positions in the cube that can occur: they are centres of voxels, or above, so that none is nearer to a
/// side of the grid than half a voxel.
bool PostureField::room_is_clear(const Scene& scene, const Cube& cube) const {
  const Vec3 first = corner_cell(cube.corner).cwiseMax(0);
  const Vec3 last = corner_cell(cube.corner + Voxel{1, 1, 1} * cube.size).cwiseMin(last_cell());
  return (first.array() > last.array()).any() || room_is_clear(scene, first, last, tool_room_voxels);
}

/// What can be come to can be left along the axis: a cell under one that may not be used may not be used either. A
/// tilted axis leads through cells that share an edge or a corner, so all those around it count.
void PostureField::close_upwards() {
  bubble_ = covered_;
  usable_ = all_cells();
  if (std::ranges::find(covered_, -1) == covered_.end()) return;
  std::vector<Voxel> above;
  for (int part = 1; part < 8; ++part) {
    const Voxel up{part & 1, part >> 1 & 1, part >> 2}, lean = view_.lean;
    if (up.i <= lean.i && up.j <= lean.j && up.k <= lean.k) above.push_back(up);
  }
  const auto usable_or_outside = [&](Voxel cell) {
    return std::max({cell.i, cell.j, cell.k}) >= fine || bubble_[index_of(cell)] >= 0;
  };
  for (int k = fine - 1; k >= 0; --k)
    for (int j = fine - 1; j >= 0; --j)
      for (int i = fine - 1; i >= 0; --i)
        for (const Voxel up : above)
          if (!usable_or_outside(Voxel{i, j, k} + up)) bubble_[index_of({i, j, k})] = -1;
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

Configuration PostureField::guess(const Vec3& cell) const {
  const Vec3 at = (cell - low_).cwiseProduct(parts_per_cell_) / parts;
  int base[3];
  double part[3];
  for (int axis = 0; axis < 3; ++axis) {
    base[axis] = std::clamp(static_cast<int>(at[axis]), 0, cells - 1);
    part[axis] = at[axis] - base[axis];
  }
  const Eigen::Index dof = chain_.dof();
  double from[4], to[4];
  const double* edges[4];  // from one node to the one beside it
  for (int edge = 0; edge < 4; ++edge) {
    const int j = edge & 1, k = edge >> 1;
    const double share = (j ? part[1] : 1 - part[1]) * (k ? part[2] : 1 - part[2]);
    from[edge] = share * (1 - part[0]);
    to[edge] = share * part[0];
    edges[edge] = &nodes_(0, node_index({base[0], base[1] + j, base[2] + k}));
  }
  Configuration sum(dof);
  for (Eigen::Index joint = 0; joint < dof; ++joint) {
    const auto along = [&](int edge) { return from[edge] * edges[edge][joint] + to[edge] * edges[edge][dof + joint]; };
    sum[joint] = along(0) + along(1) + along(2) + along(3);
  }
  return sum;
}

std::optional<Configuration> PostureField::at(const Vec3& cell) const {
  if (!usable(cell)) return std::nullopt;
  return find_posture(chain_, ball_m(cell), view_.axis(), guess(cell));
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
                              const Configuration& to, int& held, int splits) const {
  for (const Vec3& cell : {from_cell, to_cell}) {
    const std::int32_t id = bubble_[fine_cell(cell)];
    if (id < 0) continue;
    const Bubble& bubble = bubbles_[static_cast<std::size_t>(id)];
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
