// Configurations of an arm in a checkpoint.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/frame.hpp"

namespace sculpt {

nlohmann::json path_json(const std::vector<Configuration>& path);
/// Throws nlohmann's exceptions if that is none.
std::vector<Configuration> path_of(const nlohmann::json& json);

}  // namespace sculpt
