#include "core/picture/stock_moment.hpp"

#include <cmath>
#include <istream>
#include <optional>
#include <utility>
#include <vector>

#include "core/trajectory/milling/milled_stock.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/timeline.hpp"

namespace sculpt {
namespace {

VoxelSet without(VoxelSet set, const VoxelSet& taken) {
  set -= taken;
  return set;
}

struct Step {
  std::vector<std::pair<Voxel, Voxel>> runs;  ///< that go
  int tool = -1;                              ///< a change to this one
  Configuration q;                            ///< empty where it is not known
};

/// Takes from the beginning of a run what a share of its keyframe's voxels has for it; what is left of the share.
std::int64_t cut_part(VoxelSet& standing, const std::pair<Voxel, Voxel>& run, std::int64_t gone) {
  const auto& [first, last] = run;
  const int length = static_cast<int>(std::min<std::int64_t>(gone, l1(first, last) + 1));
  if (length > 0) standing.erase(first, first + sign(last - first) * (length - 1));
  return gone - length;
}

/// `moment` knows header, start and the count of keyframes; `next` gives them one by one.
template <typename Next>
void go_to(StockMoment& moment, double share, const Next& next) {
  const double at = share * static_cast<double>(moment.keyframes);
  moment.standing = moment.start.stock;
  moment.left = without(moment.start.stock, moment.start.keep);
  Configuration before = moment.header.home;
  for (std::uint64_t number = 0; const std::optional<Step> step = next(); ++number) {
    // Of this keyframe; the little more is for shares that a double does not hold exactly.
    const double part = std::clamp(at - static_cast<double>(number), 0.0, 1.0);
    std::int64_t length = 0;
    for (const auto& [first, last] : step->runs) {
      moment.left.erase(first, last);
      length += l1(first, last) + 1;
    }
    auto gone = static_cast<std::int64_t>(std::floor(part * static_cast<double>(length) + 1e-9));
    moment.removed += static_cast<std::uint64_t>(gone);
    if (step->tool >= 0 && part > 0) moment.tool = step->tool;
    for (const auto& run : step->runs) gone = cut_part(moment.standing, run, gone);
    if (step->q.size() == before.size()) {
      if (part > 0 || number == 0) moment.q = before + part * (step->q - before);
      before = step->q;
    }
  }
}

}  // namespace

StockMoment moment_of_timeline(std::string_view bytes, double share, bool ended) {
  TimelineReader counted(bytes), reader(bytes);
  StockMoment moment;
  moment.header = reader.header();
  moment.start = reader.voxels();
  while (counted.next()) ++moment.keyframes;
  go_to(moment, share, [&]() -> std::optional<Step> {
    std::optional<TimelineStep> step = reader.next();
    if (!step) return std::nullopt;
    return Step{std::move(step->runs), step->tool, {}};
  });
  if (!ended) moment.left = VoxelSet(moment.header.grid.n);
  return moment;
}

StockMoment moment_of_trajectory(std::istream& in, double share) {
  StockMoment moment;
  TrajectoryReader counted(in);
  moment.header = counted.header();
  const int n = moment.header.grid.n;
  moment.start = {VoxelSet(n, true), VoxelSet(n)};
  while (counted.next()) ++moment.keyframes;
  in.clear();
  in.seekg(0);
  TrajectoryReader reader(in);
  moment.q = moment.header.home;
  std::optional<MilledStock> milled;
  if (moment.header.mill) milled.emplace(moment.header, moment.start.stock);
  go_to(moment, share, [&]() -> std::optional<Step> {
    std::optional<Keyframe> keyframe = reader.next();
    if (!keyframe) return std::nullopt;
    Step step{{}, keyframe->mill ? keyframe->mill->tool : -1, keyframe->q};
    if (milled)
      step.runs = milled->take(*keyframe->mill, keyframe->cut);
    else if (keyframe->cut)
      step.runs = {{keyframe->first, keyframe->last}};
    return step;
  });
  moment.start.keep = moment.left;
  moment.left = VoxelSet(n);
  return moment;
}

bool is_timeline(std::string_view bytes) {
  constexpr std::string_view line = R"({"type")";  // runs of voxels that read so fit into no grid
  const std::size_t end = bytes.find('\n');
  return bytes.starts_with('{') && end != bytes.npos && !bytes.substr(end + 1).starts_with(line);
}

}  // namespace sculpt
