// The text of a program, line by line. Internal to read/.
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "core/base/error.hpp"

namespace sculpt {

/// One line of a program, taken off piece by piece.
class ProgramLine {
 public:
  ProgramLine(std::string_view text, std::size_t number) : rest_(text), number_(number) {}

  void blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
  }
  bool take(std::string_view word) {
    blanks();
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  void need(std::string_view word) {
    if (!take(word)) refuse("'" + std::string(word) + "' is missing");
  }
  double number() {
    blanks();
    double value = 0;
    const auto [end, failed] =
        std::from_chars(rest_.data(), rest_.data() + rest_.size(), value, std::chars_format::fixed);
    if (failed != std::errc() || !std::isfinite(value)) refuse("a number is missing");
    const std::string_view written = rest_.substr(0, static_cast<std::size_t>(end - rest_.data()));
    if (written.starts_with('-') && value == 0) refuse("-0 is written");
    rest_.remove_prefix(written.size());
    if (rest_.starts_with('e') || rest_.starts_with("E-") || rest_.starts_with("E+"))
      refuse("a number has an exponent");
    return value;
  }
  bool empty() {
    blanks();
    return rest_.empty();
  }
  std::string_view rest() const { return rest_; }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError("program_damaged",
                     "line " + std::to_string(number_) + " of a program: " + what + ": write it again");
  }

 private:
  std::string_view rest_;
  std::size_t number_;
};

/// Calls `take` for each line, without its end.
template <typename Take>
void for_lines(std::string_view text, bool carriage_returns, Take&& take) {
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (end == std::string_view::npos) ProgramLine(line, number + 1).refuse("the last line has no end");
    text.remove_prefix(end + 1);
    const bool returned = line.ends_with('\r');
    if (returned) line.remove_suffix(1);
    ProgramLine at(line, ++number);
    if (returned != carriage_returns) at.refuse("the line's end is not that of the dialect");
    for (const char c : line)
      if ((c < ' ' && c != '\t') || c > '~') at.refuse("a character is not ASCII");
    take(at);
  }
}

}  // namespace sculpt
