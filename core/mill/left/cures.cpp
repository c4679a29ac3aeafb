#include "core/mill/left/cures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "core/material/resolution.hpp"
#include "core/mill/map/assembly.hpp"
#include "core/mill/map/fixtures.hpp"
#include "core/mill/map/height_map.hpp"

namespace sculpt {
namespace {

/// Voxels that are looked at, about.
constexpr std::size_t samples = 400;
/// Of the heights that a body is held against.
constexpr double cell_m = 2e-3;
/// Thinner cutters that are tried.
constexpr std::array thinner_m{4e-3, 3e-3, 2e-3, 1.5e-3, 1e-3, 5e-4};
/// Around a voxel's centre: how far a ball is beside it (radii), in so many directions.
constexpr std::array aside{0.5, 0.9};
constexpr int turns = 6;

/// A cutter with a body.
struct TriedTool {
  double radius_m = 0;
  std::vector<Ring> rings;  ///< what the tool has that is thicker than the cutter; empty: whatever is needed
  std::vector<Ring> body;   ///< the same, and a neck no thicker than the cutter
  double holder_m = 0;      ///< radius of the thickest part of its own
};

/// What is in the way along one direction.
struct Sight {
  ToolFrame frame;
  std::shared_ptr<const FacetColumns> part;
  FacetColumns fixtures;
  HeightMap solid;
};

Sight make_sight(const MillJob& job, std::size_t direction, const Mesh& fixtures, PartViews& views) {
  const ToolFrame frame(mill_directions()[direction]);
  const double size = job.grid.n * job.grid.voxel_m;
  Sight view{frame, views.along(direction, frame), FacetColumns(fixtures, frame),
             HeightMap(lattice_over(frame, job.grid.origin_m, job.grid.origin_m + Vec3::Constant(size), 0.2, cell_m))};
  for (const Mesh* mesh : {&job.part, &fixtures})
    for (const auto& t : mesh->triangles)
      view.solid.raise(frame.of(mesh->vertices[t[0]]), frame.of(mesh->vertices[t[1]]), frame.of(mesh->vertices[t[2]]));
  return view;
}

/// The highest of what is solid, so near to an axis.
double top_within(const HeightMap& solid, const Vec3& tip, double radius_m) {
  float top = no_height;
  for_each_cell_near(solid.lattice, tip, tip, radius_m, [&](int a, int b) { top = std::max(top, solid.at(a, b)); });
  return static_cast<double>(top);
}

bool has_room(const Sight& view, const TriedTool& tool, const Vec3& tip) {
  return std::ranges::all_of(tool.rings, [&](const Ring& ring) {
    return top_within(view.solid, tip, ring.radius_m) <= tip.z() + ring.height_m;
  });
}

/// Places of the tip from which a ball holds a point (tool frame), as high as that can be, where it may be.
std::vector<Vec3> tips_at(const Sight& view, const Vec3& point, double radius_m, double allowance_m) {
  std::vector<Vec3> tips;
  const auto add = [&](double u, double v, double off) {
    const double height = point.z() + std::sqrt(std::max(0.0, radius_m * radius_m - off * off));
    const auto rests_higher = [&](const FacetColumns& columns) {
      return columns.rest_height(u, v, radius_m + allowance_m, height, height) > height;
    };
    if (!rests_higher(*view.part) && !rests_higher(view.fixtures)) tips.emplace_back(u, v, height - radius_m);
  };
  add(point.x(), point.y(), 0);
  for (const double share : aside)
    for (int turn = 0; turn < turns; ++turn) {
      const double angle = 2 * std::numbers::pi * turn / turns, off = share * radius_m;
      add(point.x() + off * std::cos(angle), point.y() + off * std::sin(angle), off);
    }
  return tips;
}

/// The same, exactly against the part, of a body so much thicker.
bool is_clear_by(const Sight& view, const TriedTool& tool, const Vec3& tip, double more_m) {
  return std::ranges::all_of(tool.body, [&](const Ring& ring) {
    const double radius = ring.radius_m + more_m, middle = tip.z() + ring.height_m + radius;
    return view.part->rest_height(tip.x(), tip.y(), radius, middle, middle) <= middle;
  });
}

class CureSearch {
 public:
  CureSearch(const MillJob& job, PartViews& views, const RunContext& run) : job_(job), run_(run) {
    const Mesh fixtures = fixture_mesh(job.cell);
    std::vector<std::optional<Sight>> made(mill_directions().size());
    run.helpers.for_each_index(made.size(), [&](std::size_t direction) {
      made[direction].emplace(make_sight(job, direction, fixtures, views));
    });
    for (auto& view : made) views_.push_back(std::move(*view));
    for (const MillTool& tool : job.tools) {
      TriedTool own{tool.cutter.radius_m, make_assembly(job.cell, tool).rings, {}, tool.cutter.radius_m};
      own.body = own.rings;
      // What is no thicker than the cutter goes where that does.
      std::erase_if(own.rings, [&](const Ring& ring) { return ring.radius_m <= tool.cutter.radius_m; });
      for (const HolderSection& section : tool.body)
        own.holder_m = std::max({own.holder_m, section.radius_m, section.end_radius_m});
      own_.push_back(std::move(own));
    }
    std::ranges::stable_sort(own_, std::ranges::greater{}, &TriedTool::radius_m);
    for (const double diameter : thinner_m)
      if (diameter < 2 * own_.back().radius_m) thinner_.push_back({diameter / 2, {}, {}, own_.back().holder_m});
  }

  Cure cure_of(Voxel voxel) const {
    if (run_.watch.stop.stop_requested()) throw Cancelled{};
    const Vec3 centre = job_.grid.centre(voxel);
    std::optional<Cure> longer;
    for (const TriedTool& tool : own_) {
      const std::optional<Cure> cure = try_tool(tool, centre);
      if (cure && cure->obstacle == Obstacle::way) return *cure;
      if (cure && !longer) longer = cure;
    }
    if (longer) return *longer;
    for (const TriedTool& tool : thinner_)
      if (std::optional<Cure> cure = try_tool(tool, centre)) {
        cure->obstacle = Obstacle::radius;
        return *cure;
      }
    return {};
  }

 private:
  /// With the least length that it needs to be free, or the least resolution where its own is enough; nothing where the
  /// ball cannot be.
  std::optional<Cure> try_tool(const TriedTool& tool, const Vec3& centre) const {
    std::optional<Cure> best;
    for (const Sight& view : views_)
      for (const Vec3& tip : tips_at(view, view.frame.of(centre), tool.radius_m, job_.wishes.allowance_m)) {
        Cure cure{Obstacle::way, 2 * tool.radius_m};
        if (!tool.rings.empty() && has_room(view, tool, tip))
          cure.resolution = resolution_for(view, tool, tip);
        else
          cure.obstacle = Obstacle::length,
          cure.free_m = std::max(0.0, top_within(view.solid, tip, tool.holder_m) - tip.z());
        const auto rank = [](const Cure& each) { return std::tuple(each.obstacle, each.resolution, each.free_m); };
        if (!best || rank(cure) < rank(*best)) best = cure;
        if (rank(*best) == std::tuple(Obstacle::way, job_.grid.n, 0.0)) return best;
      }
    return best;
  }

  /// The least resolution at which the tool may go there. With two voxels in the cutter's radius its passes take whole
  /// ones (of a bust D20 had room at 67 % of what was left at 32^3, at 1 % at 64^3); and as what is not wholly taken
  /// stands, its body keeps a voxel off the part.
  int resolution_for(const Sight& view, const TriedTool& tool, const Vec3& tip) const {
    int n = job_.grid.n;
    for (double voxel_m = job_.grid.voxel_m; n <= max_resolution; voxel_m /= 2, n *= 2)
      if (2 * voxel_m <= tool.radius_m && is_clear_by(view, tool, tip, voxel_m)) break;
    return n;
  }

  const MillJob& job_;
  const RunContext& run_;
  std::vector<Sight> views_;
  std::vector<TriedTool> own_, thinner_;  ///< thick ones first
};

std::vector<Voxel> chosen_of(const VoxelSet& left) {
  std::vector<Voxel> all, chosen;
  for_each_voxel(left, [&](Voxel voxel) { all.push_back(voxel); });
  const std::size_t stride = std::max<std::size_t>(1, all.size() / samples);
  for (std::size_t at = stride / 2; at < all.size(); at += stride) chosen.push_back(all[at]);
  return chosen;
}

}  // namespace

std::vector<Cure> find_cures(const MillJob& job, const VoxelSet& left, PartViews& views, const RunContext& run) {
  const std::vector<Voxel> chosen = chosen_of(left);
  if (chosen.empty()) return {};
  const CureSearch search(job, views, run);
  std::vector<Cure> found(chosen.size());
  run.helpers.for_each_index(chosen.size(), [&](std::size_t at) { found[at] = search.cure_of(chosen[at]); });
  // Of each kind one that is long and fine enough for all of it.
  std::map<std::tuple<Obstacle, double, bool>, Cure> kinds;
  for (Cure cure : found) {
    if (cure.resolution == job.grid.n || cure.resolution > max_resolution) cure.resolution = 0;
    Cure& kind = kinds.try_emplace({cure.obstacle, cure.diameter_m, cure.resolution > 0}, cure).first->second;
    kind.free_m = std::max(kind.free_m, cure.free_m);
    kind.resolution = std::max(kind.resolution, cure.resolution);
    kind.share += 1 / static_cast<double>(chosen.size());
  }
  std::vector<Cure> cures;
  for (auto& [key, cure] : kinds) {
    cure.free_m = std::ceil(1e3 * cure.free_m) / 1e3;
    cures.push_back(cure);
  }
  std::ranges::stable_sort(cures, std::ranges::greater{}, &Cure::share);
  return cures;
}

}  // namespace sculpt
