#include "core/material/binvox.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "core/base/error.hpp"
#include "core/material/resolution.hpp"
#include "core/material/voxel_rows.hpp"

namespace sculpt {
namespace {

constexpr std::string_view magic = "#binvox";

[[noreturn]] void refuse(const std::string& why) {
  throw InputError("binvox_invalid", "the .binvox file cannot be used: " + why);
}

/// Takes one line off the front of `bytes`.
std::string_view take_line(std::string_view& bytes) {
  constexpr std::size_t max_line_bytes = 1000;
  const std::size_t end = bytes.substr(0, max_line_bytes).find('\n');
  if (end == std::string_view::npos) refuse("its header ends without a line \"data\"; write it again");
  std::string_view line = bytes.substr(0, end);
  bytes.remove_prefix(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

int parse_dimensions(std::istringstream& words) {
  int depth = 0, width = 0, height = 0;
  if (!(words >> depth >> width >> height)) refuse("its line \"dim\" does not hold three whole numbers");
  const std::string given = std::to_string(depth) + " x " + std::to_string(width) + " x " + std::to_string(height);
  if (depth != width || depth != height)
    refuse("its dimensions are " + given + ", not a cube: write it with equal dimensions");
  if (!is_resolution(depth))
    refuse("its dimensions are " + given + ": write it with 8, 16, 32, 64, 128, 256, 512 or 1024 voxels an edge");
  return depth;
}

/// Reads up to and with the line "data".
BinvoxHeader take_header(std::string_view& bytes) {
  if (!bytes.starts_with(magic)) refuse("it does not start with \"#binvox\"; is it another kind of file?");
  if (take_line(bytes) != "#binvox 1") refuse("it is not of version 1: write it with binvox version 1");
  BinvoxHeader header;
  for (;;) {
    const std::string line(take_line(bytes));
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "data") break;
    if (word == "dim") {
      header.n = parse_dimensions(words);
    } else if (word == "scale") {
      if (double size_m = 0; words >> size_m) header.size_m = size_m;
    } else if (word != "translate") {
      refuse("its header has an unknown line \"" + line.substr(0, 40) + "\"");
    }
  }
  if (header.n == 0) refuse("its header has no line \"dim\"");
  return header;
}

/// One slice of fixed i, bit j + n k, for each i of a chunk of rows.
using Slices = std::vector<std::vector<std::uint64_t>>;

Slices slices_of(const VoxelSet& voxels, const VoxelRows& rows, int chunk) {
  const auto n = static_cast<std::size_t>(rows.n);
  Slices slices(static_cast<std::size_t>(rows.width), std::vector<std::uint64_t>(n * n / 64));
  for (int k = 0; k < rows.n; ++k) {
    for (int j = 0; j < rows.n; ++j) {
      const std::size_t at = j + n * k;
      for (std::uint64_t bits = rows.get(voxels, j, k, chunk); bits != 0; bits &= bits - 1)
        slices[static_cast<std::size_t>(std::countr_zero(bits))][at >> 6] |= std::uint64_t{1} << (at & 63);
    }
  }
  return slices;
}

/// Pairs of a value and how often it comes, up to 255 times.
class Runs {
 public:
  explicit Runs(std::string& out) : out_(out) {}
  void add(bool value) {
    if (value != value_ || length_ == 255) finish();
    value_ = value;
    ++length_;
  }
  void finish() {
    if (length_ == 0) return;
    out_ += static_cast<char>(value_);
    out_ += static_cast<char>(length_);
    length_ = 0;
  }

 private:
  std::string& out_;
  bool value_ = false;
  int length_ = 0;
};

Voxel voxel_at(std::size_t index, int n) {
  const int row = static_cast<int>(index / n);
  return {row / n, static_cast<int>(index % n), row % n};
}

}  // namespace

std::string write_binvox(const VoxelSet& voxels, const Grid& grid) {
  const int n = voxels.n();
  std::ostringstream header;
  header.precision(std::numeric_limits<double>::max_digits10);
  header << "#binvox 1\ndim " << n << ' ' << n << ' ' << n << "\ntranslate " << grid.origin_m.x() << ' '
         << grid.origin_m.y() << ' ' << grid.origin_m.z() << "\nscale " << n * grid.voxel_m << "\ndata\n";
  std::string out = header.str();
  Runs runs(out);
  const VoxelRows rows(n);
  for (int chunk = 0; chunk < rows.chunks; ++chunk) {
    // The format runs across the words of a set: reading bit by bit would miss the cache at every voxel of a large
    // grid.
    const Slices slices = slices_of(voxels, rows, chunk);
    for (int i = 0; i < rows.width; ++i)
      for (std::size_t at = 0; at < static_cast<std::size_t>(n) * n; ++at)
        runs.add((slices[i][at >> 6] >> (at & 63)) & 1);
  }
  runs.finish();
  return out;
}

VoxelSet read_binvox(std::string_view bytes) {
  const int n = take_header(bytes).n;
  const std::size_t total = static_cast<std::size_t>(n) * n * n;
  if (bytes.size() % 2 != 0) refuse("its data end within a run: the file is cut short, send it again");
  VoxelSet voxels(n);
  std::size_t at = 0;
  for (std::size_t pair = 0; pair < bytes.size(); pair += 2) {
    const auto value = static_cast<unsigned char>(bytes[pair]);
    const std::size_t length = static_cast<unsigned char>(bytes[pair + 1]);
    if (value > 1) refuse("a run has the value " + std::to_string(value) + ", only 0 and 1 are known");
    if (length == 0) refuse("a run has length 0; write the file again");
    if (length > total - at)
      refuse("its runs hold more voxels than the " + std::to_string(total) + " of its dimensions");
    for (std::size_t end = at + length; at < end; ++at)
      if (value == 1) voxels.insert(voxel_at(at, n));
  }
  if (at != total)
    refuse("its runs hold " + std::to_string(at) + " voxels, its dimensions need " + std::to_string(total) +
           ": the file is cut short, send it again");
  return voxels;
}

BinvoxHeader read_binvox_header(std::string_view bytes) {
  return take_header(bytes);
}

}  // namespace sculpt
