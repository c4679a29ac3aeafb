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

/// Whoever comes there at all, at a coarser resolution or shorter, before others.
auto rank(const Cure& cure) {
  return std::tuple(cure.obstacle, cure.resolution, cure.free_m);
}

void keep_better(std::optional<Cure>& best, const std::optional<Cure>& other) {
  if (other && (!best || rank(*other) < rank(*best))) best = other;
}

class CureSearch {
 public:
  CureSearch(const MillJob& job, PartViews& views, const RunContext& run)
      : job_(job), parts_(views), run_(run), fixtures_(fixture_mesh(job.cell)) {
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

  std::vector<Cure> cures_of(const std::vector<Voxel>& voxels) const {
    std::vector<Cure> cures(voxels.size());
    std::vector<Voxel> too_narrow;
    std::vector<std::size_t> numbers;
    const Found by_own = try_tools(own_, voxels);
    for (std::size_t at = 0; at < voxels.size(); ++at) {
      if (const auto cure = best_of_own(by_own[at])) {
        cures[at] = *cure;
      } else {
        too_narrow.push_back(voxels[at]);
        numbers.push_back(at);
      }
    }
    const Found by_thinner = try_tools(thinner_, too_narrow);
    for (std::size_t at = 0; at < too_narrow.size(); ++at)
      if (const auto cure = std::ranges::find_if(by_thinner[at], &std::optional<Cure>::has_value);
          cure != by_thinner[at].end()) {
        cures[numbers[at]] = **cure;
        cures[numbers[at]].obstacle = Obstacle::radius;
      }
    return cures;
  }

 private:
  /// Of each voxel, of each tool.
  using Found = std::vector<std::vector<std::optional<Cure>>>;

  /// The thickest that needs no other length, or else the thickest.
  static std::optional<Cure> best_of_own(const std::vector<std::optional<Cure>>& by_tool) {
    std::optional<Cure> longer;
    for (const std::optional<Cure>& cure : by_tool) {
      if (cure && cure->obstacle == Obstacle::way) return cure;
      if (cure && !longer) longer = cure;
    }
    return longer;
  }

  /// The best along all directions. Of a part of millions of triangles only few can be looked at along at a time.
  Found try_tools(const std::vector<TriedTool>& tools, const std::vector<Voxel>& voxels) const {
    const Found none(voxels.size(), std::vector<std::optional<Cure>>(tools.size()));
    std::vector<Found> along(voxels.empty() ? 0 : mill_directions().size(), none);
    run_.helpers.for_each_index(along.size(), [&](std::size_t direction) {
      const Sight view = make_sight(job_, direction, fixtures_, parts_);
      for (std::size_t at = 0; at < voxels.size(); ++at) {
        if (run_.watch.stop.stop_requested()) throw Cancelled{};
        for (std::size_t tool = 0; tool < tools.size(); ++tool)
          along[direction][at][tool] = try_tool(view, tools[tool], job_.grid.centre(voxels[at]));
      }
    });
    Found best = none;
    for (const Found& found : along)
      for (std::size_t at = 0; at < voxels.size(); ++at)
        for (std::size_t tool = 0; tool < tools.size(); ++tool) keep_better(best[at][tool], found[at][tool]);
    return best;
  }

  /// With the least length that it needs to be free, or the least resolution where its own is enough; nothing where the
  /// ball cannot be.
  std::optional<Cure> try_tool(const Sight& view, const TriedTool& tool, const Vec3& centre) const {
    std::optional<Cure> best;
    for (const Vec3& tip : tips_at(view, view.frame.of(centre), tool.radius_m, job_.wishes.allowance_m)) {
      Cure cure{Obstacle::way, 2 * tool.radius_m};
      if (!tool.rings.empty() && has_room(view, tool, tip)) {
        cure.resolution = resolution_for(view, tool, tip);
      } else {
        cure.obstacle = Obstacle::length;
        cure.free_m = std::max(0.0, top_within(view.solid, tip, tool.holder_m) - tip.z());
      }
      keep_better(best, cure);
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
  PartViews& parts_;
  const RunContext& run_;
  Mesh fixtures_;
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
  const std::vector<Cure> found = CureSearch(job, views, run).cures_of(chosen);
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
