#include "server/base/histogram.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace sculpt::server {

void Histogram::add(std::chrono::nanoseconds time) {
  const double seconds = std::chrono::duration<double>(time).count();
  const auto bucket = std::ranges::lower_bound(bounds_s, seconds) - bounds_s.begin();
  counts_[static_cast<std::size_t>(bucket)].fetch_add(1, std::memory_order_relaxed);
  sum_ns_.fetch_add(static_cast<std::uint64_t>(time.count()), std::memory_order_relaxed);
}

std::string Histogram::text(const std::string& name, const std::string& labels) const {
  const std::string first = labels.empty() ? "" : labels + ",";
  const std::string all = labels.empty() ? "" : "{" + labels + "}";
  std::string text;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    sum += counts_[i].load(std::memory_order_relaxed);
    const std::string bound = i < bounds_s.size() ? fmt::format("{}", bounds_s[i]) : "+Inf";
    text += fmt::format("{}_bucket{{{}le=\"{}\"}} {}\n", name, first, bound, sum);
  }
  const double seconds = static_cast<double>(sum_ns_.load(std::memory_order_relaxed)) * 1e-9;
  return text + fmt::format("{}_sum{} {}\n{}_count{} {}\n", name, all, seconds, name, all, sum);
}

}  // namespace sculpt::server
