// What a checkpoint says of milling.
#pragma once

#include <nlohmann/json.hpp>

#include "core/mill/mill_memory.hpp"
#include "core/plan/checkpoint/milled_figures.hpp"

namespace sculpt {

nlohmann::json milling_json(const MillMemory& milling);
nlohmann::json milled_json(const MilledFigures& milled);
/// Both throw nlohmann's exceptions if that is none.
MillMemory milling_of(const nlohmann::json& json);
MilledFigures milled_of(const nlohmann::json& json);

}  // namespace sculpt
