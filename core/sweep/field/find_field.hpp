// Which field of configurations serves a tool direction best.
#pragma once

#include <memory>

#include "core/base/run_context.hpp"
#include "core/sweep/field/posture_field.hpp"

namespace sculpt {

/// The field that covers most, of those that grow from the most promising starts: `home`, the `known` starts of other
/// directions with one joint turned by quarters (a turntable makes one side of the stock of another), random ones drawn
/// from the seed of `run`. It may cover nothing. Any thread. Throws Cancelled.
std::unique_ptr<PostureField> find_field(const Scene& scene, const ToolView& view, const Configuration& home,
                                         const std::vector<Configuration>& known, const RunContext& run);

}  // namespace sculpt
