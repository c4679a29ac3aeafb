#include "core/plan/intake.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/cell/ik.hpp"
#include "core/material/binvox.hpp"
#include "core/material/clamping.hpp"
#include "core/material/loose_pieces.hpp"
#include "core/material/resolution.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/motion/random_configuration.hpp"
#include "core/solid/surface/touched_voxels.hpp"

namespace sculpt {
namespace {

/// Per voxel: bit sets of stock, keep and standing material, their pyramid of counts, and the search's own marks.
constexpr double bytes_a_voxel = 1.6;
/// Of a cell's files: read, loaded as the densest kind of mesh (.obj), and made shapes of.
constexpr std::uint64_t memory_a_cell_byte = 14;
constexpr int coarse_resolution = 32;
constexpr int reach_seeds = 24;

std::string mib(std::uint64_t bytes) {
  return std::to_string((bytes >> 20) + 1) + " MiB";
}

std::uint64_t predict_file_memory(const JobSizes::File& file) {
  return file.extension == "binvox" ? file.bytes : predict_mesh_memory(file.bytes, file.extension);
}

void check_resolution(const MeshFile& voxels, int n) {
  if (const int held = read_binvox_header(voxels.bytes).n; held != n)
    throw InputError("resolution_invalid", "'" + voxels.name + "' holds " + std::to_string(held) +
                                               "^3 voxels, the job asks for " + std::to_string(n) +
                                               "^3: pass --resolution " + std::to_string(held));
}

VoxelSet read_voxels(const MeshFile& file, int n) {
  check_resolution(file, n);
  return read_binvox(file.bytes);
}

/// What is left of a block of other voxels is none of this grid.
void check_left(const MeshFile& left, const Grid& grid) {
  constexpr double tolerance_m = 1e-9;
  check_resolution(left, grid.n);
  const double size_m = grid.n * grid.voxel_m;
  const std::optional<double> left_m = read_binvox_header(left.bytes).size_m;
  if (left_m && std::abs(*left_m - size_m) > tolerance_m)
    throw InputError("cell_invalid", "the cell's stock.size_m is " + std::to_string(size_m) +
                                         ", and what is to be carved on is of a cell where it is " +
                                         std::to_string(*left_m) + ": take a cell with that size");
}

CubeTurn read_turn(const Vec3& rotation_rad) {
  if (const std::optional<CubeTurn> turn = cube_turn(rotation_rad)) return *turn;
  const Vec3 deg = rotation_rad * (180 / std::numbers::pi);
  throw InputError("placement_invalid", "the block cannot be clamped turned by " + std::to_string(deg.x()) + ", " +
                                            std::to_string(deg.y()) + ", " + std::to_string(deg.z()) +
                                            " degrees: its voxels would not be voxels again. Give multiples of 90, "
                                            "for example 180,0,0");
}

/// All that hold any of the box; what is less than a millionth of an edge counts for nothing.
VoxelSet box_voxels(const Stock::Box& box, const Grid& grid) {
  constexpr double border = 1e-6;
  VoxelSet voxels(grid.n);
  const auto is_in = [&](Voxel voxel) {
    const Eigen::Array3d low = Vec3(voxel.i, voxel.j, voxel.k).array() + border, high = low + 1 - 2 * border;
    return (box.max_m.array() / grid.voxel_m >= low).all() && (box.min_m.array() / grid.voxel_m <= high).all();
  };
  if ((box.min_m.array() < box.max_m.array()).all())
    for (int k = 0; k < grid.n; ++k)
      for (int j = 0; j < grid.n; ++j)
        for (int i = 0; i < grid.n; ++i)
          if (is_in({i, j, k})) voxels.insert({i, j, k});
  if (voxels.size() == 0)
    throw InputError("stock_empty",
                     "the stock box holds nothing of the grid: give min and max in metres from the corner of "
                     "the grid, min below max");
  return voxels;
}

/// Corners of the grid, middles of its edges and sides, and its own.
std::vector<Vec3> points_of(const Grid& grid) {
  std::vector<Vec3> points;
  for (int k : {0, grid.n / 2, grid.n - 1})
    for (int j : {0, grid.n / 2, grid.n - 1})
      for (int i : {0, grid.n / 2, grid.n - 1}) points.push_back(grid.centre({i, j, k}));
  return points;
}

/// Can the ball come to any of 27 points of the stock, with whatever axis?
void check_reach(const Cell& cell, const Grid& grid) {
  const Chain chain = cell.chain();
  Random random(1);
  double nearest = std::numeric_limits<double>::max();
  std::vector<Configuration> seeds{cell.home(chain)};
  for (int i = 1; i < reach_seeds; ++i) seeds.push_back(random_configuration(chain, random));
  for (const Vec3& point : points_of(grid))
    for (const Configuration& seed : seeds) {
      if (solve_ik(chain, {point, {}}, seed)) return;
      nearest = std::min(nearest, (chain.tool_pose(seed).ball_m - point).norm());
    }
  throw InputError("stock_out_of_reach", "cell '" + cell.name + "': the tool reaches no point of the stock at '" +
                                             cell.robot.links[static_cast<std::size_t>(cell.stock_link)].name +
                                             "' (nearest try " + std::to_string(nearest) +
                                             " m away): move the stock or the robot in the cell file");
}

}  // namespace

const Mesh& JobShapes::read(const MeshFile& file, std::optional<Mesh>& mesh, const Watch& watch) const {
  if (!mesh) mesh = load_mesh(file.bytes, file.extension, job_.memory_cap_bytes, watch);
  return *mesh;
}

VoxelSet JobShapes::make_stock(const Grid& grid, const Watch& watch) {
  const Stock& stock = job_.stock;
  if (stock.box) return box_voxels(*stock.box, grid);
  if (!stock.mesh) return VoxelSet(grid.n, true);
  if (stock.mesh->extension == "binvox") return read_voxels(*stock.mesh, grid.n);
  Mesh placed = read(*stock.mesh, stock_, watch);
  for (Vec3& vertex : placed.vertices) vertex += grid.origin_m;
  // A voxel that some of it is in is stock: nothing may go through what is there in truth.
  VoxelSet voxels = touched_voxels(placed, grid, watch);
  const VoxelSet inside = sculpt::voxelize(placed, grid, watch);
  for (std::size_t w = 0; w < voxels.words().size(); ++w) voxels.words()[w] |= inside.words()[w];
  return voxels;
}

Solid JobShapes::make_target(const Grid& grid, const Watch& watch) {
  if (job_.mesh.extension == "binvox") return {read_voxels(job_.mesh, grid.n), {}};
  const Mesh& mesh = read(job_.mesh, target_, watch);
  watch.step(Stage::load, 1, 1);
  return find_solid(place_mesh(mesh, job_.placement, grid), grid, watch);
}

Mesh JobShapes::place_part(const Grid& grid, const Watch& watch) {
  if (job_.mesh.extension == "binvox")
    throw InputError("mesh_unreadable",
                     "'" + job_.mesh.name + "' holds voxels, and milling tools need the surface: give the mesh itself");
  return place_mesh(read(job_.mesh, target_, watch), job_.placement, grid);
}

VoxelGrid JobShapes::place(const Grid& grid, const Watch& watch) {
  VoxelSet stock = make_stock(grid, watch);
  Solid target = make_target(grid, watch);
  VoxelGrid voxels{std::move(stock), std::move(target.inside), target.ambiguous};
  for (std::size_t w = 0; w < voxels.keep.words().size(); ++w) voxels.keep.words()[w] &= voxels.stock.words()[w];
  return voxels;
}

const VoxelGrid& JobShapes::voxelize(const Grid& grid, const Watch& watch) {
  if (voxels_ && voxels_->n() == grid.n) return *voxels_;
  for (const Clamping& clamping : job_.clampings) check_left(clamping.left, grid);
  VoxelGrid voxels = place(grid, watch);
  for (const Clamping& clamping : job_.clampings)
    voxels = clamp_anew(voxels, read_binvox(clamping.left.bytes), read_turn(clamping.rotation_rad));
  voxels_ = std::move(voxels);
  return *voxels_;
}

VoxelGrid JobShapes::take_voxels(const Grid& grid, const Watch& watch) && {
  voxelize(grid, watch);
  target_.reset();
  stock_.reset();
  return std::move(*voxels_);
}

VoxelGrid make_voxels(const Job& job, const Grid& grid, const Watch& watch) {
  return JobShapes(job).take_voxels(grid, watch);
}

Doubts find_doubts(const VoxelGrid& voxels, const Grid& grid) {
  Doubts doubts{voxels.keep.size(), find_loose(voxels.keep).size(), voxels.ambiguous.voxels, {}};
  const Vec3 middle_mm = 500 * (grid.centre(voxels.ambiguous.low) + grid.centre(voxels.ambiguous.high));
  if (doubts.ambiguous > 0) doubts.ambiguous_at_mm = {middle_mm.x(), middle_mm.y(), middle_mm.z()};
  return doubts;
}

JobSizes sizes_of(const Job& job) {
  JobSizes sizes{job.resolution, {job.mesh.bytes.size(), job.mesh.extension}, {}, job.cell.cell_json.size()};
  if (job.stock.mesh) sizes.stock = {job.stock.mesh->bytes.size(), job.stock.mesh->extension};
  for (const Clamping& clamping : job.clampings) sizes.left_bytes += clamping.left.bytes.size();
  for (const auto& [name, bytes] : job.cell.files) sizes.cell_bytes += bytes.size();
  return sizes;
}

std::uint64_t predict_memory(const JobSizes& sizes) {
  const double n = sizes.resolution;
  return static_cast<std::uint64_t>(bytes_a_voxel * n * n * n) + memory_a_cell_byte * sizes.cell_bytes +
         sizes.left_bytes + predict_file_memory(sizes.mesh) + (sizes.stock ? predict_file_memory(*sizes.stock) : 0);
}

void check_sizes(const JobSizes& sizes, std::uint64_t memory_cap_bytes) {
  check_resolution(sizes.resolution);
  if (const std::uint64_t bytes = predict_memory(sizes); bytes > memory_cap_bytes)
    throw InputError("memory_cap", "the job needs about " + mib(bytes) + ", over the cap of " + mib(memory_cap_bytes) +
                                       ": use a mesh (or a cell with meshes) of fewer triangles, a smaller "
                                       "resolution, or raise the memory cap");
}

namespace {

std::string mm(double metres) {
  std::ostringstream text;
  text << 1000 * metres << " mm";
  return text.str();
}

/// Keyframes are rounded by a micrometre or so, and edges that may stray by less than a few would be endless.
constexpr double min_allowance_m = 6e-6;

/// What a milling job asks for, against its tools and the cell's block.
void check_wishes(const MillOrder& order, const std::vector<MillTool>& tools, const Cell& cell) {
  const auto refuse = [](const std::string& sentence) { throw InputError("tools_invalid", sentence); };
  const double tolerance = order.tolerance_m, scallop = order.scallop(), allowance = order.allowance();
  if (!(tolerance > 0))
    refuse("a tolerance of " + mm(tolerance) + " cannot be met: give metres above 0, for example 0.0001");
  if (!(scallop > 0) || !(allowance >= 0) || scallop + allowance > tolerance)
    refuse("scallop " + mm(scallop) + " and allowance " + mm(allowance) + " do not fit into the tolerance of " +
           mm(tolerance) + ": both together must be less");
  if (allowance < min_allowance_m)
    refuse("an allowance of " + mm(allowance) + " leaves the cutter less room to stray than it needs: give at least " +
           mm(min_allowance_m) + ", or a tolerance of " + mm(min_allowance_m / MillOrder::allowance_share) +
           " or more");
  for (const MillTool& tool : tools) {
    if (tolerance > tool.cutter.radius_m)
      refuse("a tolerance of " + mm(tolerance) + " is more than the radius of '" + tool.name + "', " +
             mm(tool.cutter.radius_m) + ": give metres, for example 0.0001");
    if (2 * tool.cutter.radius_m > cell.stock_size_m)
      refuse("tool '" + tool.name + "' is " + mm(2 * tool.cutter.radius_m) + " wide, the block " +
             mm(cell.stock_size_m) + " only: take a smaller tool");
  }
}

std::vector<MillTool> check_mill(const Job& job, const Cell& cell) {
  if (!job.mill)
    throw InputError("tools_invalid", "search 'mill' needs tools: give --tools, for example --tools D20,D6");
  if (cell.chain().translating())
    throw InputError("search_unknown", "cell '" + cell.name +
                                           "' only translates, and search 'mill' turns the tool about the stock: "
                                           "take a cell with turning joints");
  if (!job.clampings.empty())
    throw InputError("search_unknown",
                     "a job with tools cannot go on with what another one left yet: plan the mesh in one clamping");
  std::vector<MillTool> tools = choose_tools(job.mill->library, job.mill->tools);
  check_wishes(*job.mill, tools, cell);
  return tools;
}

}  // namespace

CheckedJob check_job(const Job& job, const Watch& watch) {
  check_sizes(sizes_of(job), job.memory_cap_bytes);
  if (job.threads < 1)
    throw InputError("threads_invalid", "threads " + std::to_string(job.threads) + " must be 1 or more");
  Cell cell = parse_cell(job.cell);
  const Grid grid = cell.grid(job.resolution);
  std::vector<MillTool> tools;
  if (job.search == Search::mill) {
    tools = check_mill(job, cell);
  } else {
    if (job.mill)
      throw InputError("tools_invalid", std::string("tools are for search 'mill', not for '") + name(job.search) +
                                            "': leave one of the two out");
    make_tool(cell.tool, grid.voxel_m, grid.n);
  }
  if (job.search == Search::voxel && !cell.chain().translating())
    throw InputError("search_unknown", "search 'voxel' is for translating robots, and cell '" + cell.name +
                                           "' has turning joints: use octree");
  if (job.motion) check_order(*job.motion, cell, tools);
  check_reach(cell, grid);
  const bool given_as_voxels = job.mesh.extension == "binvox" || !job.clampings.empty() ||
                               (job.stock.mesh && job.stock.mesh->extension == "binvox");
  JobShapes shapes(job);
  shapes.voxelize(given_as_voxels || job.resolution <= coarse_resolution ? grid : cell.grid(coarse_resolution), watch);
  return {std::move(cell), grid, std::move(shapes), std::move(tools)};
}

}  // namespace sculpt
