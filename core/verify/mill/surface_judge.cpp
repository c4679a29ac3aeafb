#include "core/verify/mill/surface_judge.hpp"

#include <sstream>
#include <utility>

namespace sculpt {
namespace {

/// Joints and tips are rounded, so a plan may be off by two micrometres more than the one that it may cut too deep.
constexpr double max_gouge_mm = 3e-3, look_mm = 0.2;

}  // namespace

PieceFindings SurfaceJudge::take(std::vector<CutterWay> ways) {
  PieceFindings found = finish();
  judging_ = std::async(threads_ > 1 ? std::launch::async : std::launch::deferred,
                        [this, next = std::move(ways)] { return judge(next); });
  return found;
}

PieceFindings SurfaceJudge::judge(const std::vector<CutterWay>& ways) {
  PieceFindings found;
  for (const auto& [line, cutter, axis, from, to, stray] : ways) {
    if (const double depth = surface_.depth(cutter, axis, from, to, look_mm) + stray; depth > max_gouge_mm) {
      std::ostringstream sentence;
      sentence << "the cutter is up to " << depth << " mm inside the part";
      found.find(line, sentence.str());
    }
    const double r = 1000 * cutter.radius_m;
    if (cutter.kind == CutterKind::ball) points_.cut(from + r * axis, to + r * axis, r, stray);
  }
  return found;
}

}  // namespace sculpt
