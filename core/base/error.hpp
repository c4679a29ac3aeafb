// Bad input, as a stable code and a sentence that names the thing, the value and the cure.
#pragma once

#include <stdexcept>
#include <string>

namespace sculpt {

/// Thrown wherever input cannot be used; `code` is one of those in README, Troubleshooting; what
/// travels is in proto/PROTOCOL.md too.
class InputError : public std::runtime_error {
 public:
  InputError(std::string code, const std::string& sentence) : std::runtime_error(sentence), code_(std::move(code)) {}
  const std::string& code() const { return code_; }

 private:
  std::string code_;
};

/// Thrown by `Watch::step` once a stop was requested. Not an error: the work simply ends.
struct Cancelled {};

/// A disk failed to sync: the kernel may have dropped what it held, and a second try would hide that. what() names the
/// file.
class SyncError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sculpt
