// Which program of a job's plan is wanted of the server, as options of fetch and link.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "proto/json.hpp"

namespace sculpt::cli {

struct ProgramOrder {
  std::string dialect;  ///< empty: no program is wanted
  std::optional<std::string> name;
  std::optional<double> feed_m_s, rapid_m_s, keep_feed;
  std::optional<std::uint64_t> part_keyframes, part_bytes;
  bool stock_files = false, seams_in_stock = false;
};

/// --dialect, --name, --feed, --rapid, --keep-feed, --part-keyframes, --part-bytes, --stock-files and --seams-in-stock.
void add_program_options(CLI::App& command, ProgramOrder& order);

/// The field `program` of a request for this artifact; null for another one. Throws Failure (usage) where --dialect is
/// missing, or is given for another artifact.
Json program_field(const ProgramOrder& order, const std::string& artifact);

}  // namespace sculpt::cli
