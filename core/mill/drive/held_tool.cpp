#include "core/mill/drive/held_tool.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/base/random.hpp"
#include "core/material/voxel_rows.hpp"
#include "core/sweep/field/find_field.hpp"

namespace sculpt {
namespace {

constexpr int cells_around = 64;
/// Of all parts of a field: no better one is looked for.
constexpr std::size_t enough_percent = 97;

/// Columns along that axis of the grid, up or sideways, that is nearest to the direction.
ToolView view_of(const Direction& direction) {
  const auto views = tool_views(cells_around);
  const Vec3 axis = Vec3(direction[0], direction[1], direction[2]).normalized();
  ToolView view = *std::ranges::max_element(views, {}, [&](const ToolView& each) { return each.axis().dot(axis); });
  view.held = axis;
  return view;
}

Direction quarter_turned(const Direction& direction) {
  return {-direction[1], direction[0], direction[2]};
}

std::size_t usable_cells(const HeldTool::Fields& fields) {
  std::size_t usable = 0;
  for (const auto& field : fields) usable += field->usable_cells();
  return usable;
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
      guided_scene_(guided_, around, cells_of(stock, around)),
      turn_(find_stock_turn(guided_scene_.chain(), around)) {
  see(cells_of(stock, around));
}

void HeldTool::see(const VoxelSet& cells) {
  if (carrying_scene_ && cells == cells_) return;
  carrying_scene_ = std::make_unique<Scene>(carried_, around_, cells);
  cells_ = cells;
}

HeldTool::Fields HeldTool::search(const Direction& direction, const ToolView& view, const Configuration& home,
                                  const RunContext& run) const {
  std::uint64_t number = 0;
  for (const int component : direction) number = mix(number, static_cast<std::uint64_t>(component) + 1000);
  Fields fields = find_fields(guided_scene_, view, home, {home}, {mix(run.seed, number), run.helpers, run.watch});
  std::erase_if(fields, [](const auto& field) { return field->usable_cells() == 0; });
  return fields;
}

/// A direction and its quarter turns, the largest first.
struct HeldTool::Quarters {
  std::array<Direction, 4> directions;
  std::array<ToolView, 4> views;  ///< turned into each other

  explicit Quarters(const Direction& direction) {
    directions[0] = direction;
    for (std::size_t k = 1; k < 4; ++k) directions[k] = quarter_turned(directions[k - 1]);
    std::rotate(directions.begin(), std::max_element(directions.begin(), directions.end()), directions.end());
    views[0] = view_of(directions[0]);
    for (std::size_t k = 1; k < 4; ++k) views[k] = quarter_turned(views[k - 1]);
  }
};

HeldTool::Found HeldTool::search(const Quarters& quarters, const Configuration& home, const RunContext& run) const {
  Found best;
  for (std::size_t k = 0; k < 4; ++k) {
    if (100 * usable_cells(best.fields) >= enough_percent * PostureField::all_cells()) break;
    if (k > 0 && quarters.directions[k] == quarters.directions[0]) break;
    Fields fields = search(quarters.directions[k], quarters.views[k], home, run);
    if (usable_cells(fields) > usable_cells(best.fields)) best = {std::move(fields), static_cast<int>(k)};
  }
  return best;
}

/// Where the stock can be turned, a field suits four directions. A search finds other postures for each of them, and
/// the best are turned into the others'.
HeldTool::Fields HeldTool::find_turned(const Direction& direction, const Configuration& home, const RunContext& run) {
  const Quarters quarters(direction);
  const auto [at, is_new] = found_.try_emplace(quarters.directions[0]);
  Found& best = at->second;
  if (is_new) best = search(quarters, home, run);
  const auto asked = static_cast<int>(std::ranges::find(quarters.directions, direction) - quarters.directions.begin());
  const ToolView& view = quarters.views[static_cast<std::size_t>(asked)];
  Fields fields;
  for (const auto& field : best.fields)
    if (asked == best.quarter)
      fields.push_back(std::make_unique<PostureField>(*field));
    else if (auto other = turned(*field, *turn_, view, asked - best.quarter))
      fields.push_back(std::move(other));
  // The table may not turn so far.
  if (fields.empty() && !best.fields.empty()) return search(direction, view, home, run);
  return fields;
}

const HeldTool::Fields& HeldTool::fields(const Direction& direction, const Configuration& home, const RunContext& run) {
  const auto [at, is_new] = opened_.try_emplace(direction);
  auto& [fields, standing] = at->second;
  if (is_new) fields = turn_ ? find_turned(direction, home, run) : search(direction, view_of(direction), home, run);
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
