// Job ids: ULIDs (26 letters of Crockford's base 32: 48 bits of milliseconds, 80 random bits), always rising.
#pragma once

#include <cstdint>
#include <string>

namespace sculpt::server {

/// Not shared between threads.
class IdMaker {
 public:
  /// `last`: the greatest id given so far (empty: none); the next ones are greater even if the clock was set back.
  explicit IdMaker(std::string last = {}) : last_(std::move(last)) {}
  std::string next(std::uint64_t now_ms);

 private:
  std::string last_;
};

}  // namespace sculpt::server
