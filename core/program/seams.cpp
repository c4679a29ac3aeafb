#include "core/program/seams.hpp"

#include <algorithm>
#include <optional>

#include "core/base/error.hpp"
#include "core/collision/scene.hpp"
#include "core/mill/map/assembly.hpp"
#include "core/motion/line.hpp"
#include "core/motion/transit.hpp"

namespace sculpt {
namespace {

using Way = std::vector<Configuration>;

/// Along the axis until the tool's end is `clear_m` outside the grid's cube, and all of it is; 0 where it is (m).
double way_out_m(const Grid& grid, const ToolPose& pose, double clear_m) {
  constexpr double level = 1e-9;
  const double side_m = grid.n * grid.voxel_m;
  double shortest_m = std::numeric_limits<double>::infinity();
  for (int part = 0; part < 3; ++part) {
    const double at_m = pose.ball_m[part] - grid.origin_m[part], along = pose.axis[part];
    // Where the rest of the tool is no nearer to the cube.
    if ((at_m <= -clear_m && along < level) || (at_m >= side_m + clear_m && along > -level)) return 0;
    if (std::abs(along) < level) continue;
    shortest_m = std::min(shortest_m, ((along > 0 ? side_m + clear_m : -clear_m) - at_m) / along);
  }
  return shortest_m;
}

/// Follows the plan of a thin tool, and knows how it leaves the stock from where it is.
class WayOut {
 public:
  WayOut(const PlanPath& path, const PathTool& tool)
      : path_(path), scene_(tool.cell, path.header().grid, VoxelSet(path.header().grid.n, true)) {}

  /// Along its axis. Points are asked for in their order. Nothing where there is no such way.
  std::optional<Way> straight(std::size_t point) {
    go_to(point);
    return straight_by(point, 1);
  }
  /// Along its axis a part of the way, and home from there, however the arm has to bend for it.
  std::optional<Way> home(std::size_t point) {
    go_to(point);
    for (const double share : {0.5, 0.25, 0.1}) {
      auto way = straight_by(point, share);
      if (!way || way->empty()) continue;
      const Transit rest = plan_transit(scene_, way->back(), path_.configuration(0), point, {});
      if (rest.path.empty()) continue;
      way->insert(way->end(), rest.path.begin() + 1, rest.path.end());
      return way;
    }
    return {};
  }

 private:
  void go_to(std::size_t point) {
    for (; done_ <= point; ++done_)
      for (int voxel = 0; voxel < path_.edge_to(done_).voxels; ++voxel) scene_.remove(path_.voxel_of(done_, voxel));
  }

  std::optional<Way> straight_by(std::size_t point, double share) const {
    const Configuration q = path_.configuration(point);
    const ToolPose pose = scene_.chain().tool_pose(q);
    const double far_m =
        way_out_m(path_.header().grid, pose, scene_.tool().ball_radius_m + path_.header().grid.voxel_m);
    if (far_m == 0) return Way{};
    return track_line(scene_, q, pose.ball_m + share * far_m * pose.axis, pose.axis);
  }

  const PlanPath& path_;
  Scene scene_;
  std::size_t done_ = 1;
};

bool is_changed_at(const PlanPath& path, std::size_t point) {
  return path.edge_to(point + 1).tool != path.edge_to(point).tool;
}

/// Of `most` moves: a part need not be full, and most places will do.
std::vector<std::size_t> places_to_try(std::size_t most) {
  std::vector<std::size_t> places;
  for (const std::size_t eighths : {4u, 5u, 6u, 7u}) places.push_back(most * eighths / 8);
  for (const std::size_t less : {32u, 24u, 16u, 12u, 8u, 4u, 0u})
    if (most > less + most * 7 / 8) places.push_back(most - less);
  std::erase(places, std::size_t{0});
  return places;
}

/// Where a part begins, and how large it may be.
struct PartStart {
  std::size_t begin, returning;
  const PartSize& size;
  std::size_t most;  ///< moves of the path that fit, without a retreat at the end

  bool fits(std::size_t moves, const Way& leaving) const { return size.fits(begin, returning, moves, leaving.size()); }
};

/// The last place that the tool can leave, the way there included.
std::optional<Seam> find_exit(WayOut& way_out, const PartStart& part) {
  const std::size_t begin = part.begin, most = part.most;
  std::optional<Seam> found;
  const auto take = [&](std::size_t moves, std::optional<Way> way) {
    if (way && part.fits(moves, *way)) found = {begin + moves, std::move(*way)};
  };
  for (const std::size_t moves : places_to_try(most)) {
    take(moves, way_out.straight(begin + moves));
    if (!found && moves * 8 >= most * 5) take(moves, way_out.home(begin + moves));
  }
  return found;
}

/// Straight up along a milling tool's axis. Where the tool stands it was proved that nothing is above it, of part,
/// fixtures and stock (core/mill/map), so it may stray there as when it cuts; of the links it is proved here.
class Climb {
 public:
  Climb(const PathTool& tool, const Scene& links, const Configuration& start, const Vec3& axis)
      : tool_(tool), links_(links), axis_(axis), way_{start} {}

  /// Nothing where the links cannot follow, or it takes more than `most` edges.
  std::optional<Way> run(double far_m, std::size_t most) {
    most_ = most;
    const Vec3 tip = tool_.chain.tool_pose(way_.front()).ball_m;
    if (!climb(tip, tip + far_m * axis_)) return {};
    return Way(way_.begin() + 1, way_.end());
  }

 private:
  static constexpr double min_piece_m = 2e-4;

  bool climb(const Vec3& from, const Vec3& to) {
    if (way_.size() > most_) return false;
    const Configuration& start = way_.back();
    const auto end = solve_rounded(tool_.chain, {to, axis_}, start);
    if (end && strays_m(start, *end) <= tool_.room.cut_m && links_.certify(start, *end) == Contact::none) {
      way_.push_back(*end);
      return true;
    }
    if ((to - from).norm() < 2 * min_piece_m) return false;
    const Vec3 middle = (from + to) / 2;
    return climb(from, middle) && climb(middle, to);
  }

  double strays_m(const Configuration& start, const Configuration& end) const {
    EdgePlaces places;
    places.begin.put(tool_.rates, start);
    const Configuration one = Configuration::Ones(start.size());
    const EdgeSagitta sagitta = sagitta_of(tool_.rates, make_edge(tool_.rates, {one, one}, start, end, places), places);
    return std::max(sagitta.ball, sagitta.top) + sagitta.more;
  }

  const PathTool& tool_;
  const Scene& links_;
  const Vec3 axis_;
  Way way_;
  std::size_t most_ = 0;
};

/// From a place of a plan with milling tools.
std::optional<Way> climb_out(const PlanPath& path, const Cell& cell, const PathTool& tool, std::size_t point,
                             std::size_t most) {
  const Grid& grid = path.header().grid;
  const MillTool& mill = path.header().mill->tools[path.edge_to(point).tool];
  const Configuration q = path.configuration(point);
  const ToolPose pose = tool.chain.tool_pose(q);
  const double far_m = way_out_m(grid, pose, mill.cutter.radius_m + grid.voxel_m);
  if (far_m == 0) return Way{};
  VoxelSet standing(grid.n, true);  // but where the tip goes
  for (double at_m = 0; at_m < far_m; at_m += grid.voxel_m / 4) {
    const Vec3 at = (pose.ball_m + at_m * pose.axis - grid.origin_m) / grid.voxel_m;
    const Voxel middle{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
                       static_cast<int>(std::floor(at.z()))};
    for (const Voxel step : face_steps)
      for (const Voxel voxel : {middle, middle + step})
        if (grid.contains(voxel)) standing.erase(voxel);
  }
  const Cell guided = guided_by_maps(without_holder(cell), mill);
  const Scene links(guided, grid, standing);
  return Climb(tool, links, q, pose.axis).run(far_m, most);
}

/// The last place where a milling tool is over the material, on its way from cut to cut; or one where it can climb out.
std::optional<Seam> find_way_over(const PlanPath& path, const Cell& cell, const PathTools& tools,
                                  const PartStart& part) {
  const std::size_t begin = part.begin, most = part.most;
  for (std::size_t point = begin + most; point > begin; --point)
    if (!path.edge_to(point).cut && !path.edge_to(point + 1).cut) return Seam{point, {}};
  for (const std::size_t less : {most / 16, most / 8, most / 4, most / 2}) {
    const std::size_t point = begin + most - less;
    if (point == begin) continue;
    if (auto way = climb_out(path, cell, tools.on_edge_to(path, point), point, less);
        way && part.fits(point - begin, *way))
      return Seam{point, std::move(*way)};
  }
  return {};
}

[[noreturn]] void refuse(const PlanPath& path, std::size_t first, const PartSize& size) {
  std::string limit = size.moves > 0 ? std::to_string(size.moves) + " moves" : "", larger = "--part-keyframes";
  if (size.text.most > 0) {
    limit += (limit.empty() ? "" : " and ") + std::to_string(size.text.most) + " bytes";
    larger = size.moves > 0 ? "--part-bytes or --part-keyframes" : "--part-bytes";
  }
  throw InputError("part_invalid", "no part of " + limit + " from keyframe " +
                                       std::to_string(path.edge_to(first + 1).keyframe) +
                                       " on ends where the tool can leave the material: give a larger " + larger +
                                       ", or let parts begin and end in the material with --seams-in-stock");
}

/// That not even one move fits in.
[[noreturn]] void refuse_small(const PartSize& size) {
  throw InputError("part_invalid", "a part of " + std::to_string(size.text.most) +
                                       " bytes holds no move, its text takes more: give a --part-bytes of " +
                                       std::to_string(size.text.frame + 10 * size.text.retreat) + " or more");
}

/// One seam after the other.
class SeamFinder {
 public:
  SeamFinder(const PlanPath& path, const Cell& cell, const PathTools& tools, const PartSize& size)
      : path_(path), cell_(cell), tools_(tools), size_(size) {}

  /// Behind the part that begins at a point with moves that come back from a retreat; nothing where it is the last one.
  std::optional<Seam> next(std::size_t begin, std::size_t returning) {
    if (change_ <= begin) find_change(begin);
    const PartStart part{begin, returning, size_, size_.moves_from(begin, returning, change_ - begin)};
    if (part.most == change_ - begin) return change_ == last() ? std::nullopt : std::optional(Seam{change_, {}});
    if (!size_.fits(begin, 0, 1, 0)) refuse_small(size_);
    if (size_.may_be_inside) return Seam{begin + part.most, {}};
    std::optional<Seam> found = find_outside(part);
    if (!found) refuse(path_, begin, size_);
    return found;
  }

 private:
  std::size_t last() const { return path_.size() - 1; }

  /// Of tools, or the end.
  void find_change(std::size_t begin) {
    change_ = begin + 1;
    while (change_ < last() && !is_changed_at(path_, change_)) ++change_;
  }

  std::optional<Seam> find_outside(const PartStart& part) {
    if (path_.header().mill) return find_way_over(path_, cell_, tools_, part);
    if (!way_out_) way_out_.emplace(path_, tools_.first());
    return find_exit(*way_out_, part);
  }

  const PlanPath& path_;
  const Cell& cell_;
  const PathTools& tools_;
  const PartSize& size_;
  std::optional<WayOut> way_out_;  // of a thin tool, once it is needed
  std::size_t change_ = 0;
};

}  // namespace

std::vector<Seam> find_seams(const PlanPath& path, const Cell& cell, const PathTools& tools, const PartSize& size) {
  std::vector<Seam> seams;
  SeamFinder finder(path, cell, tools, size);
  std::size_t begin = 0, returning = 0;
  while (begin + 1 < path.size()) {
    std::optional<Seam> seam = finder.next(begin, returning);
    if (!seam) break;
    begin = seam->point;
    returning = seam->retreat.size();
    seams.push_back(std::move(*seam));
  }
  return seams;
}

}  // namespace sculpt
