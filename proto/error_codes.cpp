#include "proto/error_codes.hpp"

#include <algorithm>
#include <array>

namespace sculpt::proto {
namespace {

constexpr int planner_number = 5100;

constexpr std::array catalogue{
    ErrorCode{"parse_error", -32700, false},
    ErrorCode{"bad_request", -32600, false},
    ErrorCode{"unknown_method", -32601, false},
    ErrorCode{"params_invalid", -32602, false},
    ErrorCode{"internal_error", -32603, false},
    ErrorCode{"auth_required", 1001, false},
    ErrorCode{"forbidden", 1002, false},
    ErrorCode{"protocol_unsupported", 1003, false},
    ErrorCode{"hello_required", 1004, false},
    ErrorCode{"not_text", 1005, false},
    ErrorCode{"tls_required", 1006, false},
    ErrorCode{"host_refused", 1007, false},
    ErrorCode{"origin_refused", 1008, false},
    ErrorCode{"method_refused", 1009, false},
    ErrorCode{"not_found", 2001, false},
    ErrorCode{"key_conflict", 2002, false},
    ErrorCode{"wrong_state", 2003, false},
    ErrorCode{"gone", 2004, false},
    ErrorCode{"blob_missing", 2005, false},
    ErrorCode{"blob_mismatch", 2006, false},
    ErrorCode{"offset_mismatch", 2007, true},
    ErrorCode{"queue_unknown", 2008, false},
    ErrorCode{"queue_full", 3001, true, 5000},
    ErrorCode{"quota", 3002, true, 5000},
    ErrorCode{"stopping", 3003, true, 2000},
    ErrorCode{"line_too_long", 3004, false},
    ErrorCode{"too_large", 3005, false},
    ErrorCode{"reply_too_long", 3006, false},
    ErrorCode{"too_many_connections", 3007, true, 1000},
    ErrorCode{"storage_full", 4001, true, 5000},
    ErrorCode{"storage_error", 4002, false},
    ErrorCode{"artifact_damaged", 4003, false},
    ErrorCode{"db_unavailable", 4004, true, 2000},
    ErrorCode{"resolution_invalid", 5001, false},
    ErrorCode{"search_unknown", 5002, false},
    ErrorCode{"mesh_unreadable", 5003, false},
    ErrorCode{"mesh_empty", 5004, false},
    ErrorCode{"mesh_not_finite", 5005, false},
    ErrorCode{"mesh_not_solid", 5006, false},
    ErrorCode{"memory_cap", 5007, false},
    ErrorCode{"placement_invalid", 5008, false},
    ErrorCode{"target_outside_stock", 5009, false},
    ErrorCode{"cell_unknown", 5010, false},
    ErrorCode{"cell_invalid", 5011, false},
    ErrorCode{"urdf_invalid", 5012, false},
    ErrorCode{"chain_empty", 5013, false},
    ErrorCode{"tool_too_large", 5014, false},
    ErrorCode{"binvox_invalid", 5015, false},
    ErrorCode{"file_missing", 5016, false},
    ErrorCode{"trajectory_invalid", 5017, false},
    ErrorCode{"stock_empty", 5018, false},
    ErrorCode{"stock_out_of_reach", 5019, false},
    ErrorCode{"threads_invalid", 5020, false},
    ErrorCode{"no_transit", 5021, false},
    ErrorCode{"file_unwritable", 5022, false},
    ErrorCode{"tools_invalid", 5023, false},
    ErrorCode{"feed_invalid", 5024, false},
    ErrorCode{"limits_missing", 5025, false},
    ErrorCode{"feed_not_kept", 5026, false},
    ErrorCode{"window_empty", 5027, false},
    ErrorCode{"hold_invalid", 5028, false},
    ErrorCode{"dialect_unknown", 5029, false},
    ErrorCode{"axes_unfit", 5030, false},
    ErrorCode{"part_invalid", 5031, false},
    ErrorCode{"name_invalid", 5032, false},
    ErrorCode{"rounding_too_coarse", 5033, false},
    ErrorCode{"speed_too_coarse", 5034, false},
    ErrorCode{"verify_failed", 5090, false},
    ErrorCode{"out_of_memory", 5091, false},
    ErrorCode{"run_time_exceeded", 5092, false},
    ErrorCode{"planner_crashed", 5093, false},
    ErrorCode{"expired", 5094, false},
    ErrorCode{"replay_gap", 6001, false},
};

}  // namespace

std::span<const ErrorCode> error_catalogue() {
  return catalogue;
}

ErrorCode find_error(std::string_view word) {
  const auto* found = std::ranges::find(catalogue, word, &ErrorCode::word);
  return found == catalogue.end() ? ErrorCode{word, planner_number, false} : *found;
}

Json error_object(const std::string& word, const std::string& sentence, const std::string& pointer) {
  const ErrorCode code = find_error(word);
  Json data{{"code", word}, {"retryable", code.retryable}};
  if (code.retry_after_ms > 0) data["retry_after_ms"] = code.retry_after_ms;
  if (!pointer.empty()) data["pointer"] = pointer;
  return {{"code", code.number}, {"message", sentence}, {"data", std::move(data)}};
}

}  // namespace sculpt::proto
