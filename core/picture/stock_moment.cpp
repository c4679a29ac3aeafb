#include "core/picture/stock_moment.hpp"

#include <cmath>
#include <istream>

#include "core/trajectory/reader.hpp"
#include "core/trajectory/timeline.hpp"

namespace sculpt {
namespace {

template <typename Reader>
std::uint64_t count_keyframes(Reader& reader) {
  std::uint64_t keyframes = 0;
  while (reader.next()) ++keyframes;
  return keyframes;
}

VoxelSet without(VoxelSet set, const VoxelSet& taken) {
  set -= taken;
  return set;
}

/// `moment` knows header, start and the count of keyframes; the reader stands before the first of them.
template <typename Reader>
void go_to(StockMoment& moment, double share, Reader& reader) {
  const double at = share * static_cast<double>(moment.keyframes);
  moment.standing = moment.start.stock;
  moment.left = without(moment.start.stock, moment.start.keep);
  Configuration before = moment.header.home;
  for (std::uint64_t number = 0; const auto keyframe = reader.next(); ++number) {
    // Of this keyframe; the little more is for shares that a double does not hold exactly.
    const double part = std::clamp(at - static_cast<double>(number), 0.0, 1.0);
    if (keyframe->cut) {
      moment.left.erase(keyframe->first, keyframe->last);
      const int length = run_length(*keyframe), gone = static_cast<int>(std::floor(part * length + 1e-9));
      const Voxel step = sign(keyframe->last - keyframe->first);
      if (gone > 0) moment.standing.erase(keyframe->first, keyframe->first + step * (gone - 1));
      moment.removed += static_cast<std::uint64_t>(gone);
    }
    if (keyframe->q.size() == before.size()) {
      if (part > 0 || number == 0) moment.q = before + part * (keyframe->q - before);
      before = keyframe->q;
    }
  }
}

}  // namespace

StockMoment moment_of_timeline(std::string_view bytes, double share, bool ended) {
  TimelineReader counted(bytes), reader(bytes);
  StockMoment moment;
  moment.header = reader.header();
  moment.start = reader.voxels();
  moment.keyframes = count_keyframes(counted);
  go_to(moment, share, reader);
  if (!ended) moment.left = VoxelSet(moment.header.grid.n);
  return moment;
}

StockMoment moment_of_trajectory(std::istream& in, double share) {
  StockMoment moment;
  TrajectoryReader counted(in);
  moment.header = counted.header();
  const int n = moment.header.grid.n;
  moment.start = {VoxelSet(n, true), VoxelSet(n)};
  moment.keyframes = count_keyframes(counted);
  in.clear();
  in.seekg(0);
  TrajectoryReader reader(in);
  moment.q = moment.header.home;
  go_to(moment, share, reader);
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
