// A cell as blobs: what `robot: {"cell": {"blob": HASH}}` of a job refers to (proto/PROTOCOL.md, job.submit).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace sculpt::proto {

inline constexpr std::uint64_t max_cell_bundle_bytes = 8u << 20;  ///< of the bundle's own JSON

struct CellBundle {
  std::string name;
  std::string cell_json;                     ///< text of the cell file
  std::map<std::string, std::string> files;  ///< reference -> sha256 of its blob
};

/// The same bundle gives the same bytes.
std::string write_cell_bundle(const CellBundle& bundle);

/// Throws ProtocolError `params_invalid` with a pointer into the bundle.
CellBundle read_cell_bundle(std::string_view bytes);

}  // namespace sculpt::proto
