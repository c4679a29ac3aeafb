// What is refused before any planning, with a code and a cure.
#include "core/plan/intake.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

Job sound_job() {
  return make_job(shipped_cell_files("gantry"), random_target(8, 1));
}

void expect_refused(const Job& job, const std::string& code, const std::string& word) {
  try {
    check_job(job, {});
    ADD_FAILURE() << "accepted, expected " << code;
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// A cube, outwards: x and y from `low` to `low + edge`, z from `floor`.
std::string obj_box(double low, double floor, double edge) {
  std::ostringstream text;
  for (int corner = 0; corner < 8; ++corner)
    text << "v " << low + (corner & 1 ? edge : 0) << ' ' << low + (corner & 2 ? edge : 0) << ' '
         << floor + (corner & 4 ? edge : 0) << '\n';
  text << "f -8 -4 -2 -6\nf -7 -5 -1 -3\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -6 -5 -7\nf -4 -3 -1 -2\n";
  return text.str();
}

TEST(Intake, ASoundJobPasses) {
  EXPECT_NO_THROW(check_job(sound_job(), {}));
}

TEST(Intake, RefusesResolutionsThatAreNoPowerOfTwoInRange) {
  for (int n : {-1, 0, 4, 7, 24, 2048, 4096}) {
    Job job = sound_job();
    job.resolution = n;
    expect_refused(job, "resolution_invalid", std::to_string(n));
  }
}

TEST(Intake, RefusesABinvoxOfAnotherResolution) {
  Job job = sound_job();
  job.resolution = 16;
  expect_refused(job, "resolution_invalid", "--resolution 8");
}

TEST(Intake, AMeshIsReadOnce) {
  Job job;
  job.cell = shipped_cell_files("gantry");
  job.mesh = {read_file(SOURCE_DIR "/config/samples/bust.stl"), "stl", "bust.stl"};
  for (const int resolution : {16, 64}) {  // the coarse grid of the check is the job's own, and is not
    job.resolution = resolution;
    int loads = 0;
    Watch watch;
    watch.tell = [&](const Progress& at) {
      loads += at.stage == Stage::load && at.done == 0 && at.total == job.mesh.bytes.size();
    };
    CheckedJob checked = check_job(job, watch);
    const VoxelGrid voxels = std::move(checked.shapes).take_voxels(checked.grid, watch);
    EXPECT_EQ(loads, 1);
    EXPECT_EQ(voxels.n(), resolution);
    EXPECT_EQ(voxels.keep.words(), make_voxels(job, checked.grid, {}).keep.words());
  }
}

TEST(Intake, RefusesUnknownSearchesAndNoThreads) {
  try {
    parse_search("magic");
    FAIL() << "a search of that name";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "search_unknown");
    EXPECT_NE(std::string(error.what()).find("octree"), std::string::npos) << error.what();
  }
  Job job = make_job(shipped_cell_files("panda-turntable"), random_target(8, 1));
  job.search = Search::voxel;
  expect_refused(job, "search_unknown", "translating");
  job = sound_job();
  job.threads = 0;
  expect_refused(job, "threads_invalid", "0");
}

TEST(Intake, RefusesAMeshThatWouldNotFitInMemoryBeforeReadingIt) {
  Job job = sound_job();
  job.mesh = {std::string(84, '\0'), "stl", "huge.stl"};
  job.memory_cap_bytes = 1000;
  expect_refused(job, "memory_cap", "cap");
}

// Files of the stock and of the cell count like the mesh.
TEST(Intake, RefusesBySizesAlone) {
  const std::uint64_t cap = 100 << 20;
  const auto refused = [&](const JobSizes& sizes) -> std::string {
    try {
      check_sizes(sizes, cap);
      return "accepted";
    } catch (const InputError& error) {
      return error.code();
    }
  };
  JobSizes small{64, {1 << 20, "stl"}, {}, 1 << 20};
  small.stock = {1 << 20, "obj"};
  EXPECT_EQ(refused(small), "accepted");
  JobSizes sizes = small;
  sizes.resolution = 24;
  EXPECT_EQ(refused(sizes), "resolution_invalid");
  sizes.resolution = 512;
  EXPECT_EQ(refused(sizes), "memory_cap");
  sizes = small;
  sizes.mesh = {600u << 20, "stl"};
  EXPECT_EQ(refused(sizes), "memory_cap");
  sizes.mesh.extension = "binvox";
  EXPECT_EQ(refused(sizes), "memory_cap");
  sizes = small;
  sizes.stock->bytes = 20 << 20;
  EXPECT_EQ(refused(sizes), "memory_cap");
  sizes = small;
  sizes.cell_bytes = 1000ull * (20 << 20);
  EXPECT_EQ(refused(sizes), "memory_cap");
  sizes = small;
  sizes.mesh.extension = "doc";
  EXPECT_EQ(refused(sizes), "mesh_unreadable");
}

TEST(Intake, RefusesAToolThatDoesNotFitAVoxel) {
  Job job = make_job(shipped_cell_files("gantry"), random_target(16, 1));
  job.cell.cell_json = with(job.cell.cell_json, "\"ball_radius_voxels\": 0.45", "\"ball_radius_m\": 0.0063");
  expect_refused(job, "tool_too_large", "voxel");
}

TEST(Intake, RefusesAStockThatTheChainCannotReach) {
  Job job = make_job(shipped_cell_files("panda-turntable"), random_target(8, 1));
  job.cell.cell_json = with(job.cell.cell_json, "\"origin_m\": [-0.1, -0.1, 0]", "\"origin_m\": [-0.1, -0.1, 5]");
  expect_refused(job, "stock_out_of_reach", "move the stock");
}

TEST(Intake, RefusesAStockBoxThatHoldsNothing) {
  Job job = sound_job();
  job.stock.box = Stock::Box{Vec3(1, 1, 1), Vec3(2, 2, 2)};
  expect_refused(job, "stock_empty", "metres");
}

/// Of a grid of 8 voxels of 25 mm.
VoxelSet stock_of(const Job& job) {
  const Grid grid = parse_cell(job.cell).grid(job.resolution);
  return make_voxels(job, grid, {}).stock;
}

TEST(Intake, AStockHoldsAllThatSomeOfItIsIn) {
  Job job = sound_job();
  ASSERT_EQ(job.resolution, 8);
  const double edge = parse_cell(job.cell).grid(8).voxel_m;
  for (const auto& [min, max, first, last] : {std::tuple{1.0, 6.0, 1, 5}, {0.9, 6.1, 0, 6}, {1.4, 5.4, 1, 5}}) {
    job.stock = {};
    job.stock.box = Stock::Box{Vec3::Constant(min * edge), Vec3::Constant(max * edge)};
    VoxelSet expected(8);
    for (int k = first; k <= last; ++k)
      for (int j = first; j <= last; ++j)
        for (int i = first; i <= last; ++i) expected.insert({i, j, k});
    EXPECT_EQ(stock_of(job), expected) << min << " to " << max;
    job.stock = {};
    job.stock.mesh = MeshFile{obj_box(min * edge, min * edge, (max - min) * edge), "obj", "box.obj"};
    EXPECT_EQ(stock_of(job), expected) << "as a mesh, " << min << " to " << max;
  }
}

TEST(Intake, RefusesLinksAndUrdfsThatAreNotThere) {
  Job job = sound_job();
  job.cell.cell_json = with(job.cell.cell_json, "\"link\": \"stock\"", "\"link\": \"stok\"");
  expect_refused(job, "cell_invalid", "stok");
  job = sound_job();
  job.cell.files.begin()->second = "<robot";
  expect_refused(job, "urdf_invalid", "");
}

TEST(Intake, WhatTheMeshLeavesInDoubtIsCountedWithItsPlace) {
  Job job = sound_job();
  job.mesh = {obj_box(0, 0, 8) + obj_box(2, 4, 3), "obj", "nested.obj"};
  const Grid grid = parse_cell(job.cell).grid(8);
  const VoxelGrid voxels = make_voxels(job, grid, {});
  const Doubts doubts = find_doubts(voxels, grid);
  EXPECT_EQ(doubts.keep, 512u);
  EXPECT_EQ(doubts.loose_keep, 0u);
  EXPECT_EQ(doubts.ambiguous, 3u * 3 * 3);
  const Vec3 middle_mm = 1000 * (grid.origin_m + grid.voxel_m * Vec3(3.5, 3.5, 5.5));
  EXPECT_TRUE(
      Vec3(doubts.ambiguous_at_mm[0], doubts.ambiguous_at_mm[1], doubts.ambiguous_at_mm[2]).isApprox(middle_mm));
}

TEST(Intake, KeepOutsideTheStockIsAir) {
  Job job = make_job(shipped_cell_files("gantry"), VoxelSet(8, true));
  job.stock.mesh = binvox_file(random_target(8, 3), job.cell);
  const VoxelGrid voxels = make_voxels(job, parse_cell(job.cell).grid(8), {});
  EXPECT_EQ(voxels.keep, voxels.stock);
  EXPECT_EQ(voxels.stock, random_target(8, 3));
}

}  // namespace
}  // namespace sculpt
