// The cuts of a plan with milling tools, as its keyframes say them, and what they do to the surface.
#pragma once

#include <utility>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/finish/nails.hpp"
#include "core/mill/mill_job.hpp"
#include "core/mill/mill_stock.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Where a tip goes straight on while it cuts.
struct CutEdge {
  QuantaPoint from, to;
};

/// Of one tool, held in one direction.
struct MillCuts {
  int tool = 0, direction = 0;
  std::vector<CutEdge> edges;
};

/// Keyframes, one after the other from the first on -> their cuts.
class CutList {
 public:
  void add(const Keyframe& keyframe);
  std::vector<MillCuts> take() { return std::move(cuts_); }

 private:
  int tool_ = 0;
  QuantaPoint tip_{};  ///< of the keyframe before
  std::vector<MillCuts> cuts_;
};

/// What a cut leaves above the nails, in a direction whose unit vector is `axis`. Only ball cutters count.
void cut_nails(Nails& nails, const Cutter& cutter, const Vec3& axis, double stray_m, const CutEdge& edge);

/// Cuts once more what an earlier run cut: stock and nails are those of that run then, to the last bit, as neither
/// depends on the order. Throws Cancelled.
void cut_again(const MillJob& job, const std::vector<MillCuts>& cuts, MillStock& stock, Nails& nails,
               const RunContext& run);

}  // namespace sculpt
