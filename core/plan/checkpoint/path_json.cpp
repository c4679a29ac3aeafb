#include "core/plan/checkpoint/path_json.hpp"

namespace sculpt {

nlohmann::json path_json(const std::vector<Configuration>& path) {
  nlohmann::json json = nlohmann::json::array();
  for (const Configuration& q : path) json.push_back(std::vector<double>(q.begin(), q.end()));
  return json;
}

std::vector<Configuration> path_of(const nlohmann::json& json) {
  std::vector<Configuration> path;
  for (const nlohmann::json& values : json) {
    Configuration q(static_cast<Eigen::Index>(values.size()));
    for (std::size_t at = 0; at < values.size(); ++at) q[static_cast<Eigen::Index>(at)] = values[at].get<double>();
    path.push_back(std::move(q));
  }
  return path;
}

}  // namespace sculpt
