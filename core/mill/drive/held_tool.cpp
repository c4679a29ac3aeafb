#include "core/mill/drive/held_tool.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/random.hpp"
#include "core/material/voxel_rows.hpp"
#include "core/sweep/field/find_field.hpp"

namespace sculpt {
namespace {

constexpr int cells_around = 64;

/// Columns along that axis of the grid, up or sideways, that is nearest to the direction.
ToolView view_of(const Direction& direction) {
  const auto views = tool_views(cells_around);
  const Vec3 axis = Vec3(direction[0], direction[1], direction[2]).normalized();
  ToolView view = *std::ranges::max_element(views, {}, [&](const ToolView& each) { return each.axis().dot(axis); });
  view.held = axis;
  return view;
}

template <typename Visit>
void for_each_cell_of(const Vec3& low, const Vec3& high, const Grid& around, const Visit& visit) {
  constexpr double slack = 1e-9;
  const Vec3 first = (low - around.origin_m) / around.voxel_m, last = (high - around.origin_m) / around.voxel_m;
  const auto whole = [&](double value) { return std::clamp(static_cast<int>(std::floor(value)), 0, around.n - 1); };
  for (int k = whole(first.z() + slack); k <= whole(last.z() - slack); ++k)
    for (int j = whole(first.y() + slack); j <= whole(last.y() - slack); ++j)
      for (int i = whole(first.x() + slack); i <= whole(last.x() - slack); ++i) visit(Voxel{i, j, k});
}

}  // namespace

/// The stock's edge is a whole, even number of cells.
Grid grid_around(const Grid& stock, double room_m) {
  const double size = stock.n * stock.voxel_m;
  int across = cells_around - 2;
  const auto beside = [](int cells) { return (cells_around - cells) / 2; };
  while (across > 2 && size / across * beside(across) < room_m) across -= 2;
  const double cell = size / across;
  return {cells_around, cell, stock.origin_m - Vec3::Constant(cell * beside(across))};
}

VoxelSet cells_of(const Grid& stock, const Grid& around) {
  VoxelSet cells(around.n);
  for_each_cell_of(stock.origin_m, stock.origin_m + Vec3::Constant(stock.n * stock.voxel_m), around,
                   [&](Voxel cell) { cells.insert(cell); });
  return cells;
}

VoxelSet cells_of(const VoxelSet& standing, const Grid& stock, const Grid& around) {
  VoxelSet cells(around.n);
  const VoxelRows rows(standing.n());
  for (int k = 0; k < standing.n(); ++k)
    for (int j = 0; j < standing.n(); ++j)
      for (int chunk = 0; chunk < rows.chunks; ++chunk) {
        std::uint64_t bits = rows.get(standing, j, k, chunk);
        while (bits != 0) {
          const int first = std::countr_zero(bits), count = std::countr_one(bits >> first);
          bits &= first + count == 64 ? ~(~std::uint64_t{0} << first) : ~std::uint64_t{0} << (first + count);
          const Vec3 low = stock.origin_m + stock.voxel_m * Vec3(chunk * rows.width + first, j, k);
          for_each_cell_of(low, low + stock.voxel_m * Vec3(count, 1, 1), around,
                           [&](Voxel cell) { cells.insert(cell); });
        }
      }
  return cells;
}

HeldTool::HeldTool(const Cell& cell, const MillTool& tool, const Grid& stock, const Grid& around)
    : assembly_(make_assembly(cell, tool)),
      around_(around),
      carried_(sculpt::carrying(cell, tool)),
      guided_(guided_by_maps(cell, tool)),
      guided_scene_(guided_, around, cells_of(stock, around)) {
  see(cells_of(stock, around));
}

void HeldTool::see(const VoxelSet& cells) {
  if (carrying_scene_ && cells == cells_) return;
  carrying_scene_ = std::make_unique<Scene>(carried_, around_, cells);
  cells_ = cells;
}

const HeldTool::Fields& HeldTool::fields(const Direction& direction, const Configuration& home, const RunContext& run) {
  const auto [at, is_new] = opened_.try_emplace(direction);
  auto& [fields, standing] = at->second;
  if (is_new) {
    std::uint64_t number = 0;
    for (const int component : direction) number = mix(number, static_cast<std::uint64_t>(component) + 1000);
    fields =
        find_fields(guided_scene_, view_of(direction), home, {home}, {mix(run.seed, number), run.helpers, run.watch});
    std::erase_if(fields, [](const auto& field) { return field->usable_cells() == 0; });
  }
  if (!is_new && standing == cells_) return fields;
  standing = cells_;
  const VoxelSet all(PostureLattice::fine, true);
  for (auto& field : fields)
    if (field->usable_cells() < PostureField::all_cells())
      field = std::make_unique<PostureField>(*field, guided_scene_, guided_scene_.stock_of(cells_), all, run.helpers,
                                             run.watch);
  return fields;
}

Vec3 HeldTool::cell_of(const PostureField& field, const Grid& around, const Vec3& point) {
  const ToolView& view = field.view();
  const Vec3 at = (point - around.origin_m) / around.voxel_m - Vec3::Constant(0.5) -
                  Vec3(view.corner.i, view.corner.j, view.corner.k);
  Vec3 cell;
  for (int part = 0; part < 3; ++part) {
    const Voxel step = view.step[static_cast<std::size_t>(part)];
    cell[part] = at.dot(Vec3(step.i, step.j, step.k));
  }
  return cell;
}

}  // namespace sculpt
