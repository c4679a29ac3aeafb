// Which fields of configurations serve a tool direction best.
#pragma once

#include <memory>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/sweep/field/posture_field.hpp"

namespace sculpt {

/// Fields that together cover much, a few at most, the first one most for what it costs: they grow from the most
/// promising starts, those that have room where none before had. Tried are `home`, the `known` starts of other
/// directions with one joint turned by quarters (a turntable makes one side of the stock of another), and random ones
/// drawn from the seed of `run`; above the middle of the stock, and if that is not enough nearer to its sides. The
/// first may cover nothing, others do not. Any thread. Throws Cancelled.
std::vector<std::unique_ptr<PostureField>> find_fields(const Scene& scene, const ToolView& view,
                                                       const Configuration& home,
                                                       const std::vector<Configuration>& known, const RunContext& run);

}  // namespace sculpt
