#include "server/base/progress_text.hpp"

namespace sculpt::server {

Json progress_json(const Progress& progress) {
  const Doubts& doubts = progress.doubts;
  return {static_cast<int>(progress.stage),
          progress.done,
          progress.total,
          doubts.keep,
          doubts.loose_keep,
          doubts.ambiguous,
          doubts.ambiguous_at_mm};
}

std::optional<Progress> read_progress(const Json& json) try {
  const int stage = json.at(0);
  if (stage < 0 || stage > static_cast<int>(Stage::write)) return std::nullopt;
  return Progress{static_cast<Stage>(stage), json.at(1), json.at(2), {json.at(3), json.at(4), json.at(5), json.at(6)}};
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

std::optional<Progress> read_progress_text(const std::string& text) try {
  return text.empty() ? std::nullopt : read_progress(proto::parse_json(text));
} catch (const proto::JsonError&) {
  return std::nullopt;
}

}  // namespace sculpt::server
