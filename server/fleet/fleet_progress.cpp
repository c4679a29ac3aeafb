#include "server/fleet/fleet_progress.hpp"

#include "proto/json.hpp"

namespace sculpt::server {

std::string progress_text(const Progress& progress) {
  const Doubts& doubts = progress.doubts;
  return proto::write_json({static_cast<int>(progress.stage), progress.done, progress.total, doubts.keep,
                            doubts.loose_keep, doubts.ambiguous, doubts.ambiguous_at_mm});
}

std::optional<Progress> read_progress_text(const std::string& text) try {
  if (text.empty()) return std::nullopt;
  const Json json = proto::parse_json(text);
  const int stage = json.at(0);
  if (stage < 0 || stage > static_cast<int>(Stage::write)) return std::nullopt;
  return Progress{static_cast<Stage>(stage), json.at(1), json.at(2), {json.at(3), json.at(4), json.at(5), json.at(6)}};
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace sculpt::server
