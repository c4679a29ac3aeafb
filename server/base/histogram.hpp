// How long things take, in the fixed buckets that Prometheus adds up.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

namespace sculpt::server {

/// Safe from any thread.
class Histogram {
 public:
  static constexpr std::array<double, 12> bounds_s{0.0001, 0.001, 0.003, 0.01, 0.03, 0.1, 1, 10, 60, 600, 3600, 36000};

  void add(std::chrono::nanoseconds time);
  /// The lines of a Prometheus histogram; `labels`: none, or like `stage="plan"`.
  std::string text(const std::string& name, const std::string& labels) const;

 private:
  std::array<std::atomic<std::uint64_t>, bounds_s.size() + 1> counts_{};  // the last one: above all bounds
  std::atomic<std::uint64_t> sum_ns_ = 0;
};

}  // namespace sculpt::server
