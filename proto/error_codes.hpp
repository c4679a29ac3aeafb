// The errors catalogue of proto/PROTOCOL.md section 6, and the exception that carries one of them.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "proto/json.hpp"

namespace sculpt::proto {

struct ErrorCode {
  std::string_view word;
  int number;
  bool retryable;
  int retry_after_ms = 0;  ///< 0: nobody knows when
};

/// The whole catalogue, in the order of PROTOCOL.md.
std::span<const ErrorCode> error_catalogue();

/// A word that is not in the catalogue is a planner's: number 5100, not retryable.
ErrorCode find_error(std::string_view word);

/// A request that cannot be served. what() is a sentence with the cure.
class ProtocolError : public std::runtime_error {
 public:
  ProtocolError(std::string code, const std::string& sentence, std::string pointer = {})
      : std::runtime_error(sentence), code_(std::move(code)), pointer_(std::move(pointer)) {}
  const std::string& code() const { return code_; }
  /// JSON pointer (RFC 6901) into the request line to the field to blame, or empty.
  const std::string& pointer() const { return pointer_; }

 private:
  std::string code_;
  std::string pointer_;
};

/// The `error` object of a reply.
Json error_object(const std::string& word, const std::string& sentence, const std::string& pointer = {});

}  // namespace sculpt::proto
