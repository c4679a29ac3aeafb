// Rows carved by the shipped arm with its turntable, a configuration every voxel or four; then the same with faults.
#include <gtest/gtest.h>

#include "core/cell/ik.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/writer.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

constexpr int layers = 2;

Cell panda_turntable() {
  return parse_cell(read_cell_files(std::string(SOURCE_DIR) + "/config/cells/panda-turntable.json"));
}

struct ArmProgram {
  int n, rows, stride;  // rows a layer, voxels a cut
  Cell cell = panda_turntable();
  Chain chain = cell.chain();
  Grid grid = cell.grid(n);
  VoxelGrid voxels{VoxelSet(n, true), VoxelSet(n)};
  TrajectoryHeader header;
  std::vector<Keyframe> keyframes;
  Configuration q = rounded(cell.home(chain));

  explicit ArmProgram(int resolution = 16, int rows_a_layer = 16, int voxels_a_cut = 1)
      : n(resolution), rows(rows_a_layer), stride(voxels_a_cut) {
    header.joints = chain.names();
    header.home = q;
    header.grid = grid;
    header.tool = make_tool(cell.tool, grid.voxel_m);
    header.tolerance_m = (stride > 1 ? 0.04 : 0.02) * grid.voxel_m;
    header.cell = cell.name;
    move(Vec3(-2, 0.5, n + 1));
    for (int k = n - 1; k >= n - layers; --k) {
      move(Vec3(-0.5, 0.5, k + 1.5));
      for (int j = 0; j < rows; ++j) add_row(j, k);
      for (int step = 0; step <= 4; ++step) move(Vec3(-0.5, (rows - 0.5) * (4 - step) / 4, k + 1.5));
    }
    move(Vec3(-2, 0.5, n + 1));
    keyframes.push_back({header.home, false, {}, {}});
  }

  void add_row(int j, int k) {
    const bool forth = j % 2 == 0;
    move(Vec3(forth ? -0.5 : n + 0.5, j + 0.5, k + 0.5));
    for (int step = 0; step < n; step += stride) {
      const int last = step + stride - 1;
      const Voxel from{forth ? step : n - 1 - step, j, k}, to{forth ? last : n - 1 - last, j, k};
      reach(Vec3(to.i + 0.5, j + 0.5, k + 0.5));
      keyframes.push_back({q, true, from, to});
    }
    move(Vec3(forth ? n + 0.5 : -0.5, j + 0.5, k + 0.5));
  }
  void reach(const Vec3& at) {
    IkSettings settings;
    settings.centring = 0;  // stay on this branch
    const auto found = solve_ik(chain, {grid.origin_m + grid.voxel_m * at, Vec3::UnitZ()}, q, settings);
    ASSERT_TRUE(found) << at.transpose();
    q = rounded(*found);
  }
  void move(const Vec3& at) {
    reach(at);
    keyframes.push_back({q, false, {}, {}});
  }
  Verdict verdict() const {
    std::ostringstream out;
    TrajectoryWriter writer(out, header);
    for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
    writer.finish();
    return verify_text(out.str(), cell, voxels);
  }
};

TEST(ArmReplay, LayersCarvedRowByRowAreClean) {
  const ArmProgram program;
  const Verdict verdict = program.verdict();
  EXPECT_TRUE(verdict.clean) << sentences(verdict);
  EXPECT_EQ(verdict.voxels_checked, static_cast<std::uint64_t>(layers * 16 * 16));
  EXPECT_EQ(verdict.left.size(), static_cast<std::size_t>((16 - layers) * 16 * 16));
}

TEST(ArmReplay, ACutThatFreesAPieceIsFound) {
  ArmProgram program;
  const Voxel foot{0, 0, 0};  // of the one column that holds both layers
  for (int k = 0; k < 16 - layers; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i)
        if (Voxel{i, j, 0} != foot) program.voxels.stock.erase({i, j, k});
  const Verdict verdict = program.verdict();
  EXPECT_EQ(verdict.collisions, 1u);
  EXPECT_EQ(verdict.freed, 16u * 16 - 1);
  EXPECT_TRUE(found(verdict, {"voxel (0, 0, 14)", "255 voxels"})) << sentences(verdict);
  const std::uint64_t line = verdict.findings.at(0).line;
  const Keyframe& keyframe = program.keyframes.at(line - 2);
  EXPECT_EQ(keyframe.first, (Voxel{0, 0, 14}));
}

TEST(ArmReplay, OneKeyframeOffByATenthOfAVoxelIsFound) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ArmProgram program;
    Random random(seed);
    std::size_t at = 0;
    while (!program.keyframes[at].cut) at = static_cast<std::size_t>(random.next() % program.keyframes.size());
    const Vec3 aside = 0.1 * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)).normalized();
    const Voxel voxel = program.keyframes[at].last;
    program.q = program.keyframes[at].q;
    program.reach(Vec3(voxel.i + 0.5, voxel.j + 0.5, voxel.k + 0.5) + aside);
    program.keyframes[at].q = program.q;
    EXPECT_FALSE(program.verdict().clean);
  }
}

TEST(ArmReplay, RunsAreCleanAndTheirFaultsAreFound) {
  const ArmProgram good(64, 6, 4);
  const Verdict clean = good.verdict();
  EXPECT_TRUE(clean.clean) << sentences(clean);
  EXPECT_EQ(clean.voxels_checked, static_cast<std::uint64_t>(layers * 6 * 64));
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ArmProgram program = good;
    Random random(seed);
    std::size_t at = 0;
    while (!program.keyframes[at].cut) at = static_cast<std::size_t>(random.next() % program.keyframes.size());
    Keyframe& keyframe = program.keyframes[at];
    switch (seed % 4) {
      case 0: {
        program.q = keyframe.q;
        const Vec3 aside = Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)).normalized();
        program.reach(Vec3(keyframe.last.i + 0.5, keyframe.last.j + 0.5, keyframe.last.k + 0.5) + 0.1 * aside);
        keyframe.q = program.q;
        break;
      }
      case 1:
        keyframe.first.k -= 1;
        keyframe.last.k -= 1;
        break;
      case 2:
        std::swap(keyframe, program.keyframes[at + (program.keyframes[at + 1].cut ? 1 : 4)]);
        break;
      default:
        program.keyframes.insert(program.keyframes.begin() + static_cast<std::ptrdiff_t>(at), Keyframe(keyframe));
    }
    EXPECT_FALSE(program.verdict().clean);
  }
}

TEST(ArmReplay, TwoLayersSwappedAreFound) {
  ArmProgram program;
  const std::ptrdiff_t layer = 1 + program.n * (program.n + 2) + 5;
  std::rotate(program.keyframes.begin() + 1, program.keyframes.begin() + 1 + layer,
              program.keyframes.begin() + 1 + 2 * layer);
  EXPECT_TRUE(found(program.verdict(), {"shank", "material"}));
}

TEST(ArmReplay, ADroppedWayAroundTheBlockIsFound) {
  ArmProgram program;
  // From the end of the last layer straight to a row below it, through the block.
  program.keyframes.resize(program.keyframes.size() - 2);
  program.move(Vec3(-0.5, 0.5, program.n - 4.5));
  program.move(Vec3(program.n + 0.5, program.n - 0.5, program.n - 4.5));
  EXPECT_TRUE(found(program.verdict(), {"ball", "material"}));
}

TEST(ArmReplay, ASpindleLoweredIntoTheTableIsFound) {
  ArmProgram program;
  program.keyframes.resize(1);
  program.move(Vec3(-2, program.n / 2.0, 1));
  program.move(Vec3(-2, program.n / 2.0, -6));
  program.move(Vec3(-2, program.n / 2.0, 1));
  EXPECT_FALSE(program.verdict().clean);
}

}  // namespace
}  // namespace sculpt
