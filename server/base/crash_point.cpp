#include "server/base/crash_point.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <csignal>
#include <string>
#include <string_view>

#include "server/base/config.hpp"

namespace sculpt::server {
namespace {

// In the order of the enum.
constexpr std::array<std::string_view, 17> names{
    "recovered",     "blob_written",       "blob_synced",   "blob_renamed", "before_commit", "after_commit",
    "submit_stored", "trajectory_planned", "draft_written", "draft_synced", "draft_renamed", "artifacts_synced",
    "ending_known",  "ending_stored",      "export_synced", "job_removed",  "files_removed"};
static_assert(names.size() == static_cast<std::size_t>(CrashPoint::files_removed) + 1);

CrashPoint armed{};
std::atomic<int> visits_left = 0;

[[noreturn]] void refuse(std::string_view wanted) {
  std::string all;
  for (const std::string_view name : names) all += (all.empty() ? "" : ", ") + std::string(name);
  throw ConfigError("SCULPT_CRASH_AT='" + std::string(wanted) + "' must be NAME or NAME:N, NAME one of " + all);
}

}  // namespace

bool crash_point_armed = false;

void arm_crash_point(const char* wanted) {
  if (wanted == nullptr) return;
  const std::string_view text = wanted;
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto* const found = std::ranges::find(names, text.substr(0, colon));
  int visits = 1;
  if (colon < text.size()) {
    const std::from_chars_result read = std::from_chars(text.data() + colon + 1, text.data() + text.size(), visits);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size() || visits < 1) refuse(text);
  }
  if (found == names.end()) refuse(text);
  armed = static_cast<CrashPoint>(found - names.begin());
  visits_left = visits;
  crash_point_armed = true;
}

void visit_crash_point(CrashPoint point) {
  if (point == armed && --visits_left == 0) ::kill(::getpid(), SIGKILL);
}

}  // namespace sculpt::server
