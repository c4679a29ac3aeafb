#include "core/motion/gantry/gantry_carve.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/pipe.hpp"
#include "core/cell/ik.hpp"
#include "core/motion/gantry/room.hpp"
#include "core/search/translating.hpp"
#include "core/search/voxel_search.hpp"

namespace sculpt {
namespace {

/// The corners above the grid.
std::array<Voxel, 4> entries(int n) {
  return {translating_entry(n), {n - 1, 0, n}, {0, n - 1, n}, {n - 1, n - 1, n}};
}

class GantryCarve {
 public:
  GantryCarve(Gantry& gantry, const Scene& scene, const GantryTask& task, const RunContext& run)
      : gantry_(gantry),
        scene_(scene),
        task_(task),
        keep_(task.keep),
        beside_(run.helpers.threads() > 1),
        watch_(run.watch),
        room_(scene, task.home, run.watch),
        wanted_(scene.material().solid().size() - task.keep.size()) {}

  void run() {
    for (const Voxel entry : entries(keep_.n())) {
      if (!room_.is_open(entry)) continue;
      carve_from(entry);
      if (gantry_.entered()) break;
    }
    gantry_.go_home();
  }

 private:
  /// Until nothing opens any more. What the robot itself touched of the material may be free once that is gone.
  void carve_from(Voxel entry) {
    gantry_.begin_at(entry);
    for (std::size_t before = standing().size();;) {
      if (!carve_until_refused(entry)) {
        if (!gantry_.entered()) return;
        continue;
      }
      if (standing().size() == before || !look_again()) return;
      before = standing().size();
    }
  }

  /// False if a step was refused.
  bool carve_until_refused(Voxel entry) try {
    VoxelGrid voxels{standing(), keep_};
    Ground ground{gantry_.at(), entry, {}, blocked_, nullptr};
    const Grid grid{keep_.n(), 1, Vec3::Zero()};
    for (const Voxel position : room_.closed()) {
      if (!grid.contains(position)) {
        ground.closed.push_back(position);
        continue;
      }
      voxels.stock.insert(position);
      voxels.keep.insert(position);
    }
    std::optional<Support> support;
    if (task_.may_fall != nullptr) ground.support = &support.emplace(standing(), *task_.may_fall);
    // The search knows nothing of what is certified: it goes ahead until a step is refused. Told is what is done.
    std::uint64_t done = wanted_ + keep_.size() - standing().size();
    const auto follow = [&](const VoxelRun& run) {
      gantry_.follow(run);
      if (run.cut) done += static_cast<std::uint64_t>(l1(run.first, run.last) + 1);
      watch_.step(Stage::plan, std::min(wanted_, done), wanted_);
    };
    Pipe<VoxelRun> runs(follow, beside_);
    const auto put = [&runs](const VoxelRun& run) { runs.put(run); };
    const Watch watch{watch_.stop, {}};
    if (task_.search == Search::voxel) {
      carve_voxelwise(voxels, ground, put, watch);
    } else {
      const Octree octree = build_octree(voxels, watch);
      carve_translating(voxels, octree, build_block_graph(octree, watch), ground, put, watch);
    }
    runs.finish();
    return true;
  } catch (const Refusal& refusal) {
    blocked_.emplace_back(refusal.from, refusal.to);
    return false;
  }

  bool look_again() {
    const bool opened = room_.look_again(scene_);
    const auto is_free = [&](const std::pair<Voxel, Voxel>& step) {
      const auto configuration = [&](Voxel v) {
        return solve_ik(scene_.chain(), {scene_.grid().centre(v), {}}, task_.home);
      };
      const auto from = configuration(step.first), to = configuration(step.second);
      return from && to && scene_.certify(*from, *to, step.second) == Contact::none;
    };
    return std::erase_if(blocked_, is_free) > 0 || opened;
  }

  const VoxelSet& standing() const { return scene_.material().solid(); }

  Gantry& gantry_;
  const Scene& scene_;
  const GantryTask& task_;
  const VoxelSet& keep_;
  bool beside_;
  const Watch& watch_;
  Room room_;
  std::uint64_t wanted_;
  std::vector<std::pair<Voxel, Voxel>> blocked_;
};

}  // namespace

void carve_with_gantry(Scene& scene, const GantryTask& task, const GantryStart& start, const GantryListener& listener,
                       const RunContext& run) {
  Gantry gantry(scene, task.home, run.seed, run.watch.stop, start, listener);
  try {
    GantryCarve(gantry, scene, task, run).run();
  } catch (const Cancelled&) {
    if (gantry.is_on_its_own()) listener.stopped();
    throw;
  }
}

}  // namespace sculpt
