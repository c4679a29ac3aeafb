#include "core/sweep/field/posture_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/cell/ik.hpp"

namespace sculpt {
namespace {

/// Nodes beside each other may not differ by more in any joint (rad or m): else they are on two branches.
constexpr double max_joint_step = 0.35;
constexpr double max_midpoint_deviation = 0.02;  // rad or m: of a node from the middle of two that are beside it
constexpr int node_steps = 3;                    // from one node to the next
constexpr int between_steps = 2;                 // from what is interpolated between them
constexpr double close_m = 1e-6;
constexpr double along_m = 1e-3;      // of a point high up on the tool: there are chains that cannot hold its direction
constexpr double headroom_cells = 2;  // beyond the grid, on the sides that the axis leans to: where the tool comes in
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

bool is_solved(const PostureBatch& batch, std::size_t lane) {
  return batch.ball_off_m[lane] < close_m && batch.top_off_m[lane] < along_m;
}

}  // namespace

PostureLattice::PostureLattice(const Chain& chain, const Grid& grid, const ToolView& view, const Start& start,
                               const Watch& watch)
    : chain_(chain),
      grid_(grid),
      view_(view),
      lanes_(chain_, view.axis()),
      start_(start),
      low_(Vec3::Constant(-0.5)),
      span_(Vec3::Constant(view.n) + headroom_cells * Vec3(view.lean.i, view.lean.j, view.lean.k)),
      parts_per_cell_(fine * span_.cwiseInverse()),
      nodes_(Eigen::MatrixXd::Constant(chain_.dof(), nodes * nodes * nodes, nowhere)) {
  grow(watch);
}

void PostureLattice::turn(const ToolView& view, const Configuration& turn) {
  view_ = view;
  lanes_ = PostureLanes(chain_, view.axis());
  start_.q += turn;
  nodes_.colwise() += turn;
}

Vec3 PostureLattice::corner_cell(Voxel corner) const {
  return low_ + Vec3(corner.i, corner.j, corner.k).cwiseProduct(span_) / fine;
}

Vec3 PostureLattice::middle_cell(Voxel corner, int size) const {
  return corner_cell(corner) + span_ * (0.5 * size / fine);
}

Vec3 PostureLattice::last_cell() const {
  return Vec3(low_ + span_) - 0.5 * Vec3(1 - view_.lean.i, 1 - view_.lean.j, 1 - view_.lean.k);
}

Voxel PostureLattice::part(const Vec3& cell) const {
  const Vec3 at = (cell - low_).cwiseProduct(parts_per_cell_);
  const auto whole = [](double x) { return std::clamp(static_cast<int>(x), 0, fine - 1); };
  return {whole(at.x()), whole(at.y()), whole(at.z())};
}

/// Every other node from the one before, from the first outwards; those between them by interpolation,
/// which is as good as exact; what is missing then from neighbours.
void PostureLattice::grow(const Watch& watch) {
  spread({{first_node(), start_.q}}, 2, watch);
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
void PostureLattice::spread(std::deque<Visit> queue, int stride, const Watch& watch) {
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
      if (is_solved(batch, at)) {
        q = batch.q.get(lane, chain_.dof());
      } else {  // it keeps off joint limits
        q = solve_ik(chain_, {ball_m(corner_cell(node * parts)), view_.axis()}, guess);
      }
      if (!q || (node != first_node() && (*q - guess).cwiseAbs().maxCoeff() > stride * max_joint_step)) continue;
      node_at(node) = *q;
      for (const Voxel step : face_steps)
        if (is_node(node + step * stride)) queue.push_back({node + step * stride, *q});
    }
  }
}

/// The nodes between those, along x, then y, then z.
void PostureLattice::fill_between() {
  for (int axis = 0; axis < 3; ++axis)
    for_each_node([&](Voxel node) {
      const int last_odd = node.k % 2 ? 2 : node.j % 2 ? 1 : node.i % 2 ? 0 : -1;
      if (axis != last_odd) return;
      if (const auto q = find_between(node, {axis == 0, axis == 1, axis == 2})) node_at(node) = *q;
    });
}

/// From the nodes beside it and those beyond them, by Lagrange's polynomial through the four, three at the rim. Nothing
/// where that differs much from the straight line between the two beside it, or these are on two branches.
std::optional<Configuration> PostureLattice::find_between(Voxel node, Voxel along) const {
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

bool PostureLattice::has_nodes(Voxel corner, int size) const {
  const Voxel low{corner.i / parts, corner.j / parts, corner.k / parts};
  const int last = std::max(1, size / parts);
  for (int k = 0; k <= last; ++k)
    for (int j = 0; j <= last; ++j)
      for (int i = 0; i <= last; ++i)
        if (!has_node(low + Voxel{i, j, k})) return false;
  return true;
}

std::vector<Configuration> PostureLattice::find_corners(Voxel lowest, int size) const {
  std::vector<Configuration> corners;
  PostureBatch between;
  const int stride = std::min(size, parts), along = size / stride + 1;
  corners.reserve(static_cast<std::size_t>(along * along * along));
  for (int k = 0; k <= size; k += stride)
    for (int j = 0; j <= size; j += stride)
      for (int i = 0; i <= size; i += stride) {
        const Voxel corner = lowest + Voxel{i, j, k};
        const Vec3 cell = corner_cell(corner);
        if (size < parts) between.set(static_cast<int>(corners.size()), ball_m(cell), guess(cell));
        corners.emplace_back(node_at({corner.i / parts, corner.j / parts, corner.k / parts}));
      }
  if (size < parts) {
    lanes_.solve(between, between_steps);
    for (int lane = 0; lane < 8; ++lane) {
      if (!is_solved(between, static_cast<std::size_t>(lane))) return {};
      corners[static_cast<std::size_t>(lane)] = between.q.get(lane, chain_.dof());
    }
  }
  return corners;
}

JointBox PostureLattice::bounds() const {
  JointBox box{Configuration::Constant(chain_.dof(), std::numeric_limits<double>::max()),
               Configuration::Constant(chain_.dof(), std::numeric_limits<double>::lowest())};
  for (const auto& node : nodes_.colwise()) {
    if (std::isnan(node[0])) continue;
    box.low = box.low.cwiseMin(node);
    box.high = box.high.cwiseMax(node);
  }
  if ((box.low.array() > box.high.array()).any()) return {};
  const Configuration spare = Configuration::Constant(chain_.dof(), 1e-3) + 0.1 * (box.high - box.low);
  return {box.low - spare, box.high + spare};
}

Configuration PostureLattice::guess(const Vec3& cell) const {
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

}  // namespace sculpt
