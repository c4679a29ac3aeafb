#include "core/trajectory/text/plain_line.hpp"

#include "core/trajectory/quantum.hpp"
#include "core/trajectory/text/trajectory_line.hpp"

namespace sculpt {
namespace {

constexpr int fraction_digits = 7, max_whole_digits = 8;
static_assert(quanta_per_unit == 1e7);

class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool skip(std::string_view text) {
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }

  bool at_end() const { return rest_.empty(); }

  // A multiple of the quantum as a decimal, with up to 7 digits after the point.
  bool read_value(double& value) {
    const bool negative = skip("-");
    std::int64_t quanta = 0;
    if (!read_whole(max_whole_digits, quanta)) return false;
    int digits = 0;
    if (skip(".")) {
      for (; digits < fraction_digits && next_is_digit(); ++digits) quanta = 10 * quanta + take_digit();
      if (digits == 0) return false;
    }
    if (skip("e-0")) {  // small values are written so
      if (!next_is_digit()) return false;
      digits += take_digit();
      if (digits > fraction_digits) return false;
    }
    for (; digits < fraction_digits; ++digits) quanta *= 10;
    if (negative && quanta == 0) return false;
    value = from_quanta(negative ? -quanta : quanta);
    return true;
  }

  bool read_count(std::int64_t most, std::int64_t& value) { return read_whole(10, value) && value <= most; }

  bool read_voxel(Voxel& voxel) {
    std::int64_t i = 0, j = 0, k = 0;
    if (!skip("[") || !read_whole(4, i) || !skip(",") || !read_whole(4, j) || !skip(",") || !read_whole(4, k) ||
        !skip("]"))
      return false;
    voxel = {static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)};
    return true;
  }

 private:
  bool next_is_digit() const { return !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; }

  int take_digit() {
    const int digit = rest_.front() - '0';
    rest_.remove_prefix(1);
    return digit;
  }

  // JSON has no leading zeros.
  bool read_whole(int max_digits, std::int64_t& value) {
    if (!next_is_digit()) return false;
    value = take_digit();
    if (value == 0) return !next_is_digit();
    for (int digits = 1; next_is_digit(); ++digits) {
      if (digits == max_digits) return false;
      value = 10 * value + take_digit();
    }
    return true;
  }

  std::string_view rest_;
};

}  // namespace

namespace {

/// What follows the joints of a line of format 2.
bool read_mill_step(Scanner& scanner, const TrajectoryHeader& header, Keyframe& keyframe) {
  MillStep& step = keyframe.mill.emplace();
  if (!keyframe.cut && scanner.skip("]}")) return true;
  std::int64_t direction = 0, removed = 0;
  if (!scanner.skip(R"(],"direction":)") ||
      !scanner.read_count(static_cast<std::int64_t>(header.mill->directions.size()) - 1, direction) ||
      !scanner.skip(R"(,"tip":[)"))
    return false;
  step.direction = static_cast<int>(direction);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double value = 0;
    if ((axis > 0 && !scanner.skip(",")) || !scanner.read_value(value) || std::abs(value) > max_tip_m) return false;
    step.tip[axis] = *to_quanta(value);
  }
  if (!keyframe.cut) return scanner.skip("]}");
  const std::int64_t n = header.grid.n;
  if (!scanner.skip(R"(],"removed":)") || !scanner.read_count(n * n * n, removed) || !scanner.skip("}")) return false;
  step.removed = static_cast<std::uint32_t>(removed);
  return true;
}

}  // namespace

std::optional<Keyframe> read_plain_line(std::string_view text, const TrajectoryHeader& header) {
  Scanner scanner(text);
  Keyframe keyframe;
  keyframe.cut = scanner.skip(R"({"type":"cut","q":[)");
  if (!keyframe.cut && !scanner.skip(R"({"type":"move","q":[)")) return {};
  keyframe.q.resize(static_cast<Eigen::Index>(header.joints.size()));
  for (Eigen::Index joint = 0; joint < keyframe.q.size(); ++joint)
    if ((joint > 0 && !scanner.skip(",")) || !scanner.read_value(keyframe.q[joint])) return {};
  if (header.mill) {
    if (!read_mill_step(scanner, header, keyframe) || !scanner.at_end()) return {};
    return keyframe;
  }
  if (keyframe.cut) {
    if (!scanner.skip(R"(],"voxels":[)") || !scanner.read_voxel(keyframe.first) || !scanner.skip(",") ||
        !scanner.read_voxel(keyframe.last))
      return {};
    if (!is_run(keyframe, header.grid)) return {};
  }
  if (!scanner.skip("]}") || !scanner.at_end()) return {};
  return keyframe;
}

}  // namespace sculpt
