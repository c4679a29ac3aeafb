// Derivatives of the tool's two ends along a line of configurations, by central differences.
#pragma once

#include "core/cell/chain.hpp"

namespace sculpt {

struct ToolDerivatives {
  struct End {
    Vec3 second_m, third_m, fourth_m;  ///< by t
  };
  End ball, top;
};

/// At t = 0, along q + t * step. Good to about 1e-5 where joints step by less than 1.
inline ToolDerivatives tool_derivatives(const Chain& chain, const Configuration& q, const Configuration& step) {
  const auto of_end = [&](double up_m) -> ToolDerivatives::End {
    const auto at = [&](double t) -> Vec3 {
      const ToolPose pose = chain.tool_pose(q + t * step);
      return pose.ball_m + up_m * pose.axis;
    };
    const double h = 1e-3, wide = 1e-2;
    return {(at(h) - 2 * at(0) + at(-h)) / (h * h), (at(2 * h) - 2 * at(h) + 2 * at(-h) - at(-2 * h)) / (2 * h * h * h),
            (at(2 * wide) - 4 * at(wide) + 6 * at(0) - 4 * at(-wide) + at(-2 * wide)) / (wide * wide * wide * wide)};
  };
  return {of_end(0), of_end(chain.stickout_m())};
}

}  // namespace sculpt
