#include "core/motion/behind.hpp"

#include <algorithm>
#include <utility>

#include "core/motion/tool/tool_axes.hpp"
#include "core/motion/tool/tool_reach.hpp"

namespace sculpt {
namespace {

/// Reasons from the one that got farthest, and what is said of what is behind.
constexpr std::pair<Reason, Reason> in_the_way[] = {{Reason::loose_piece, Reason::behind_loose_piece},
                                                    {Reason::no_transit, Reason::behind_no_transit},
                                                    {Reason::link_collision, Reason::behind_link_collision},
                                                    {Reason::joint_limits, Reason::behind_joint_limits},
                                                    {Reason::out_of_reach, Reason::behind_out_of_reach}};

bool comes_before(const VoxelSet& set, Voxel a, Voxel b) {
  return set.index(a) < set.index(b);
}

/// What is in order of index in `all` and not in `some`.
std::vector<Voxel> without(const VoxelSet& set, const std::vector<Voxel>& all, const std::vector<Voxel>& some) {
  std::vector<Voxel> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest),
                      [&](Voxel a, Voxel b) { return comes_before(set, a, b); });
  return rest;
}

/// What stands less and less as voxels with one reason after the other are thought away.
class Behind {
 public:
  Behind(const Scene& scene, const ToolRoom& room, const Helpers& helpers, const Watch& watch)
      : scene_(scene),
        room_(room),
        helpers_(helpers),
        watch_(watch),
        axes_(tool_axes()),
        standing_(scene.material().solid()) {}

  void think_away(Voxel v) { standing_.erase(v); }

  /// Those of `wanted` that the tool comes to one after the other; they are thought away too.
  std::vector<Voxel> take_free(const std::vector<Voxel>& wanted) {
    std::vector<Voxel> tried = wanted;
    for (;;) {
      const double length = scene_.tool().stickout_m / scene_.grid().voxel_m;
      const std::vector<Voxel> left = find_out_of_tool_reach(standing_, tried, tool_steps(), length, watch_);
      const std::vector<Voxel> free = without(standing_, tried, left), stuck = find_stuck(free);
      if (stuck.empty()) {
        for (const Voxel v : free) think_away(v);
        return free;
      }
      tried = without(standing_, tried, stuck);
    }
  }

 private:
  /// Those that the tool has no room at even then, for its holder or the shank's end.
  std::vector<Voxel> find_stuck(const std::vector<Voxel>& free) const {
    if (free.empty()) return {};
    VoxelSet rest = standing_;
    for (const Voxel v : free) rest.erase(v);
    const Material material(rest);
    std::vector<char> stuck(free.size());
    helpers_.for_each_index(free.size(), [&](std::size_t at) {
      if (watch_.stop.stop_requested()) throw Cancelled{};
      stuck[at] = std::none_of(axes_.begin(), axes_.end(),
                               [&](const Vec3& axis) { return room_.is_free(material, free[at], axis); });
    });
    std::vector<Voxel> voxels;
    for (std::size_t at = 0; at < free.size(); ++at)
      if (stuck[at]) voxels.push_back(free[at]);
    return voxels;
  }

  const Scene& scene_;
  const ToolRoom& room_;
  const Helpers& helpers_;
  const Watch& watch_;
  std::vector<Vec3> axes_;
  VoxelSet standing_;
};

/// Behind for a robot that only shifts its tool: what no air is beside waits for what is beside it.
void find_shut_in(std::vector<Residue>& residue, const Scene& scene) {
  const VoxelSet& solid = scene.material().solid();
  const Grid bounds{solid.n(), 1, Vec3::Zero()};
  const auto residue_at = [&](Voxel v) {
    return std::lower_bound(residue.begin(), residue.end(), v,
                            [&](const Residue& left, Voxel at) { return comes_before(solid, left.voxel, at); });
  };
  VoxelSet shut_in(solid.n());
  for (const Residue& left : residue) {
    const bool open = std::any_of(face_steps.begin(), face_steps.end(), [&](Voxel step) {
      const Voxel beside = left.voxel + step;
      return beside.k >= 0 && !(bounds.contains(beside) && solid.contains(beside));
    });
    if (left.reason == Reason::no_transit && !open) shut_in.insert(left.voxel);
  }
  for (const auto& [reason, behind_it] : in_the_way) {
    std::vector<Voxel> next;
    for (const Residue& left : residue)
      if (left.reason == reason && !shut_in.contains(left.voxel)) next.push_back(left.voxel);
    while (!next.empty()) {
      const Voxel here = next.back();
      next.pop_back();
      for (const Voxel step : face_steps) {
        const Voxel beside = here + step;
        if (!bounds.contains(beside) || !shut_in.contains(beside)) continue;
        shut_in.erase(beside);
        residue_at(beside)->reason = behind_it;
        next.push_back(beside);
      }
    }
  }
  for_each_voxel(shut_in, [&](Voxel v) { residue_at(v)->reason = Reason::tool_cannot_reach; });
}

}  // namespace

void find_behind(std::vector<Residue>& residue, const Scene& scene, const ToolRoom& room, const Helpers& helpers,
                 const Watch& watch) {
  if (scene.chain().translating()) return find_shut_in(residue, scene);
  const VoxelSet& solid = scene.material().solid();
  std::vector<Voxel> wanted;
  for (const Residue& left : residue)
    if (left.reason == Reason::tool_cannot_reach) wanted.push_back(left.voxel);
  Behind behind(scene, room, helpers, watch);
  for (const auto& [reason, behind_it] : in_the_way) {
    const auto has_it = [&, which = reason](const Residue& left) { return left.reason == which; };
    if (wanted.empty() || std::none_of(residue.begin(), residue.end(), has_it)) continue;
    for (const Residue& left : residue)
      if (has_it(left)) behind.think_away(left.voxel);
    const std::vector<Voxel> free = behind.take_free(wanted);
    wanted = without(solid, wanted, free);
    for (const Voxel v : free)
      std::lower_bound(residue.begin(), residue.end(), v, [&](const Residue& left, Voxel at) {
        return comes_before(solid, left.voxel, at);
      })->reason = behind_it;
  }
}

}  // namespace sculpt
