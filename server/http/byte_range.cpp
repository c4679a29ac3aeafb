#include "server/http/byte_range.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace sculpt::server {
namespace {

std::optional<std::uint64_t> read_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

ByteRange last_bytes(std::uint64_t wanted, std::uint64_t size) {
  const std::uint64_t bytes = std::min(wanted, size);
  if (bytes == 0) return {ByteRange::Kind::unsatisfiable};
  return {ByteRange::Kind::part, size - bytes, bytes};
}

}  // namespace

ByteRange read_range(std::string_view header, std::uint64_t size) {
  constexpr std::string_view unit = "bytes=";
  if (!header.starts_with(unit) || header.find(',') != std::string_view::npos) return {};
  const std::string_view range = header.substr(unit.size());
  const std::size_t dash = range.find('-');
  if (dash == std::string_view::npos) return {};
  const std::optional<std::uint64_t> first = read_number(range.substr(0, dash)),
                                     last = read_number(range.substr(dash + 1));
  if (dash == 0) return last ? last_bytes(*last, size) : ByteRange{};
  const bool open = dash + 1 == range.size();
  if (!first || (!last && !open) || (last && *last < *first)) return {};
  if (*first >= size) return {ByteRange::Kind::unsatisfiable};
  return {ByteRange::Kind::part, *first, open ? size - *first : std::min(*last - *first, size - *first - 1) + 1};
}

}  // namespace sculpt::server
