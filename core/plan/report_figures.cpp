#include "core/plan/report_figures.hpp"

#include <algorithm>
#include <map>

#include "core/material/loose_pieces.hpp"

namespace sculpt {
void count_voxels(Report& report, const VoxelGrid& voxels, const Doubts& doubts, const Octree& octree) {
  const auto n = static_cast<std::uint64_t>(voxels.n());
  const std::uint64_t stock = voxels.stock.size();
  report.voxels.total = n * n * n;
  report.voxels.air = report.voxels.total - stock;
  report.voxels.keep = voxels.keep.size();
  report.voxels.remove = stock - report.voxels.keep;
  report.voxels.loose_keep = doubts.loose_keep;
  if (doubts.loose_keep > 0) report.voxels.loose_keep_pieces = count_pieces(find_loose(voxels.keep));
  report.voxels.ambiguous = doubts.ambiguous;
  report.octree.leaves = octree.leaves.size();
  for (const Block& block : octree.leaves)
    if (block.label == Label::remove) ++report.octree.remove_leaves;
}

void count_path(Report& report, const PathFigures& figures, double voxel_m, std::uint64_t checks) {
  report.path = {figures.keyframes, figures.rows,     figures.transits,
                 figures.cut_m,     figures.travel_m, figures.joint_travel_rad};
  report.voxels.removed = figures.removed;
  report.quality.turns = figures.turns;
  if (figures.removed == 0) return;
  const auto removed = static_cast<double>(figures.removed);
  report.quality.moves_per_voxel = (figures.cut_m + figures.travel_m) / (voxel_m * removed);
  report.quality.checks_per_voxel = static_cast<double>(checks) / removed;
}

void list_unchecked_links(Report& report, const Scene& scene) {
  const auto name = [&](int link) { return scene.chain().robot().links[static_cast<std::size_t>(link)].name; };
  for (const UncheckedLinks& pair : scene.unchecked_links())
    report.unchecked_links.push_back({name(pair.links.first), name(pair.links.second), pair.why});
}

void count_residue(Report& report, const std::vector<Residue>& residue) {
  report.voxels.residue = residue.size();
  std::map<Reason, std::uint64_t> counts;
  for (const Residue& left : residue) ++counts[left.reason];
  report.residue.assign(counts.begin(), counts.end());
}

void count_replay(Report& report, const Verdict& verdict) {
  report.verify = {verdict.clean, verdict.collisions, verdict.voxels_checked, verdict.exempt_pairs};
  report.voxels.freed = verdict.freed;
  for (const Finding& finding : verdict.findings)
    report.findings.push_back("line " + std::to_string(finding.line) + ": " + finding.sentence);
}

ExcessFigures excess_figures(std::vector<double> excess, double tolerance_m) {
  ExcessFigures figures;
  figures.points = excess.size();
  if (excess.empty()) return figures;
  std::ranges::sort(excess);
  const auto share = [&](double of) {
    return excess[std::min(excess.size() - 1, static_cast<std::size_t>(of * static_cast<double>(excess.size())))];
  };
  figures.within_tolerance = static_cast<std::uint64_t>(std::ranges::upper_bound(excess, tolerance_m) - excess.begin());
  figures.p50_m = share(0.5);
  figures.p95_m = share(0.95);
  figures.p99_m = share(0.99);
  figures.max_m = excess.back();
  return figures;
}

void count_surface(Report& report, const SurfaceVerdict& surface, const ExcessFigures& reachable, double tolerance_m) {
  report.surface = {excess_figures(surface.excess_m, tolerance_m), reachable, surface.base_points,
                    surface.gouged_points, surface.gouge_m};
}

}  // namespace sculpt
