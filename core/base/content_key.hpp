// A name for what something depends on: a hash of values in order, none of which can be mistaken for another.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/frame.hpp"
#include "core/base/sha256.hpp"

namespace sculpt {

class ContentKey {
 public:
  void add(std::string_view text);
  void add(std::uint64_t number);
  void add(double value);
  void add(const Vec3& v);
  std::string hex() { return hash_.hex(); }

 private:
  Sha256 hash_;
};

/// Of the file of the running program, in hex; read at the first call, "" hashed where it cannot be read. Any thread.
const std::string& program_hash();

}  // namespace sculpt
