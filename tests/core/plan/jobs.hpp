// Jobs for tests: small random targets, the shipped cells, and the folder of shared data where there is one.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/base/random.hpp"
#include "core/material/binvox.hpp"
#include "core/material/loose_pieces.hpp"
#include "core/plan/plan.hpp"

namespace sculpt {

inline std::filesystem::path shared_data() {
  const char* folder = std::getenv("SCULPT_SHARED_DATA");
  return folder != nullptr ? folder : SOURCE_DIR "/../shared/data";
}

/// Of an environment variable: how much a long run by hand tries.
inline std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
  const char* value = std::getenv(variable);
  return value == nullptr ? otherwise : std::strtoull(value, nullptr, 10);
}

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline CellFiles shipped_cell_files(const std::string& name) {
  return read_cell_files(std::filesystem::path(SOURCE_DIR) / "config/cells" / (name + ".json"));
}

/// The gantry with more in its room: URDF collision elements, in the stock's frame.
inline CellFiles gantry_beside(const std::string& fixtures) {
  CellFiles cell = shipped_cell_files("gantry");
  std::string& urdf = cell.files.begin()->second;
  urdf.insert(urdf.find("</link>"), fixtures);
  return cell;
}

/// A clamp over one edge of the stock, and a sheet through its middle that fits between two voxels.
inline CellFiles clamped_gantry() {
  return gantry_beside(
      "<collision><origin xyz='0.09 0 0.1'/><geometry><box size='0.06 0.08 0.2'/></geometry></collision>"
      "<collision><origin xyz='0 0 0.05'/><geometry><box size='0.0003 0.1 0.1'/></geometry></collision>");
}

inline MeshFile binvox_file(const VoxelSet& target, const CellFiles& cell) {
  return {write_binvox(target, parse_cell(cell).grid(target.n())), "binvox", "target.binvox"};
}

/// A few random boxes, balls and single voxels of keep: overhangs, holes, floating parts and all.
inline VoxelSet random_target(int n, std::uint64_t seed) {
  Random random(seed);
  VoxelSet target(n);
  const int parts = 1 + static_cast<int>(random.next() % 5);
  for (int part = 0; part < parts; ++part) {
    const Vec3 centre(random.between(0, n), random.between(0, n), random.between(0, n));
    const Vec3 half(random.between(0.3, n / 3.0), random.between(0.3, n / 3.0), random.between(0.3, n / 3.0));
    const bool ball = random.unit() < 0.5;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const Vec3 off = (Vec3(i + 0.5, j + 0.5, k + 0.5) - centre).cwiseQuotient(half);
          if (ball ? off.norm() < 1 : off.cwiseAbs().maxCoeff() < 1) target.insert({i, j, k});
        }
  }
  return target;
}

/// Without the parts that hang on nothing.
inline VoxelSet on_the_floor(VoxelSet target) {
  const VoxelSet loose = find_loose(target);
  for (std::size_t word = 0; word < loose.words().size(); ++word) target.words()[word] &= ~loose.words()[word];
  return target;
}

inline Job make_job(const CellFiles& cell, const VoxelSet& target, std::uint64_t seed = 0) {
  Job job;
  job.cell = cell;
  job.mesh = binvox_file(target, cell);
  job.resolution = target.n();
  job.seed = seed;
  return job;
}

/// A trajectory file of this test's own, gone at the end.
class ScratchFile {
 public:
  ScratchFile() {
    std::string pattern = (std::filesystem::temp_directory_path() / "sculpt-test-XXXXXX").string();
    const int handle = mkstemp(pattern.data());
    if (handle >= 0) close(handle);
    path_ = pattern;
  }
  ~ScratchFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace sculpt
