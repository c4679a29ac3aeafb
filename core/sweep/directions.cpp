#include "core/sweep/directions.hpp"

#include <algorithm>
#include <utility>

#include "core/base/helpers.hpp"
#include "core/base/random.hpp"
#include "core/cell/ik.hpp"
#include "core/collision/clearance.hpp"
#include "core/sweep/field/find_field.hpp"

namespace sculpt {
namespace {

constexpr std::size_t top = 0, first_side = 1, sides = 4;  // of tool_views
constexpr int max_blocks = 32;                             // along an edge of the grid

/// The parts of a field that blocks of voxels lie in.
VoxelSet parts_of(const PostureField& field, const VoxelSet& blocks) {
  const ToolView& view = field.view();
  const int size = view.n / blocks.n();
  VoxelSet parts(PostureLattice::fine);
  for_each_voxel(blocks, [&](Voxel block) {
    const Voxel first = block * size, last = first + Voxel{1, 1, 1} * (size - 1);
    const Voxel a = field.part(ToolView::place(view.cell(first))), b = field.part(ToolView::place(view.cell(last)));
    for (int k = std::min(a.k, b.k); k <= std::max(a.k, b.k); ++k)
      for (int j = std::min(a.j, b.j); j <= std::max(a.j, b.j); ++j)
        for (int i = std::min(a.i, b.i); i <= std::max(a.i, b.i); ++i) parts.insert({i, j, k});
  });
  return parts;
}

/// They, what is around and above them, and the top of the field, over which the ball comes.
VoxelSet with_ways_in(const VoxelSet& parts) {
  constexpr int around = 1, top_layers = 2;
  const int n = parts.n();
  VoxelSet all(n);
  for_each_voxel(parts, [&](Voxel part) {
    for (int j = std::max(0, part.j - around); j <= std::min(n - 1, part.j + around); ++j)
      for (int i = std::max(0, part.i - around); i <= std::min(n - 1, part.i + around); ++i)
        for (int k = part.k; k < n && !all.contains({i, j, k}); ++k) all.insert({i, j, k});
  });
  for (int k = n - top_layers; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) all.insert({i, j, k});
  return all;
}

std::size_t count_usable(const PostureField& field, const VoxelSet& parts) {
  std::size_t usable = 0;
  for_each_voxel(parts, [&](Voxel part) { usable += field.usable_part(part); });
  return usable;
}

}  // namespace

Directions::Directions(const Scene& scene, const Configuration& home, const RunContext& run, FieldStore store)
    : scene_(scene),
      home_(home),
      run_(run),
      store_(std::move(store)),
      turn_(find_stock_turn(scene.chain(), scene.grid())) {}

/// The top and the first side are searched for; the other sides too, where the stock cannot be turned.
void Directions::find_straight_fields() {
  const auto views = tool_views(scene_.grid().n);
  const std::size_t apart = turn_ ? first_side + 1 : views.size();
  std::vector<Fields> found(views.size());
  run_.helpers.for_each_index(apart, [&](std::size_t number) { found[number] = search(views[number], number); });
  for (std::size_t number = apart; number < views.size(); ++number) {
    for (const auto& field : found[first_side])
      if (auto other = turned(*field, *turn_, views[number], static_cast<int>(number - first_side)))
        found[number].push_back(std::move(other));
    if (found[number].empty()) found[number] = search(views[number], number);
  }
  for (std::size_t number = 0; number < views.size(); ++number)
    for (auto& field : found[number]) ways_.push_back({views[number], std::move(field)});
  straight_ = ways_.size();
  run_.helpers.for_each_index(straight_, [&](std::size_t way) { find_reach(ways_[way]); });
  for (const ToolView& view : tilted_views(scene_.grid().n)) ways_.push_back({view});
}

bool Directions::open(const Opening& opening) {
  const Body standing = scene_.stock_of(opening.standing);
  std::vector<std::unique_ptr<PostureField>> opened(straight_);
  std::vector<VoxelSet> wanted;
  for (std::size_t way = 0; way < straight_; ++way) wanted.push_back(parts_of(*ways_[way].field, opening.wanted));
  run_.helpers.for_each_index(straight_, [&](std::size_t way) {
    const PostureField& field = *ways_[way].field;
    if (count_usable(field, wanted[way]) < wanted[way].size())
      opened[way] =
          std::make_unique<PostureField>(field, scene_, standing, with_ways_in(wanted[way]), run_.helpers, run_.watch);
  });
  const std::size_t before = ways_.size();
  for (std::size_t way = 0; way < straight_; ++way) {
    if (!opened[way]) continue;
    std::size_t covered = count_usable(*ways_[way].field, wanted[way]);
    for (std::size_t other = straight_; other < before; ++other)
      if (ways_[other].opens == way) covered = std::max(covered, count_usable(*ways_[other].field, wanted[way]));
    if (count_usable(*opened[way], wanted[way]) <= covered) continue;
    ways_.push_back({ways_[way].view, std::move(opened[way]), {}, way});
    find_reach(ways_.back());
  }
  return ways_.size() > before;
}

VoxelSet Directions::blocks_of(const VoxelSet& voxels) {
  const int blocks = std::min(voxels.n(), max_blocks), size = voxels.n() / blocks;
  VoxelSet all(blocks);
  for_each_voxel(voxels, [&](Voxel v) { all.insert({v.i / size, v.j / size, v.k / size}); });
  return all;
}

void Directions::find_reach(Way& way) const {
  const PostureField& field = *way.field;
  way.reach.emplace(
      scene_.grid().n, [&](const Vec3& cell) { return field.part(cell); },
      [&](Voxel part) { return field.usable_part(part); });
}

const PostureField& Directions::field(std::size_t direction) {
  if (!ways_[direction].field) ways_[direction].field = find_tilted(direction);
  return *ways_[direction].field;
}

std::vector<std::size_t> Directions::tilted_found() const {
  std::vector<std::size_t> found;
  for (std::size_t way = 0; way < ways_.size(); ++way)
    if (!is_straight(way) && ways_[way].field) found.push_back(way);
  return found;
}

std::size_t Directions::number_of(const PostureField& field) const {
  const auto is_it = [&](const Way& way) { return way.field.get() == &field; };
  return static_cast<std::size_t>(std::ranges::find_if(ways_, is_it) - ways_.begin());
}

/// The first of each four that are quarter turns of each other is searched for. It is turned into the others', if the
/// stock can be.
std::unique_ptr<PostureField> Directions::find_tilted(std::size_t direction) {
  const std::size_t quarters = (direction - straight_) % sides;
  if (turn_ && quarters > 0)
    if (auto other = turned(field(direction - quarters), *turn_, ways_[direction].view, static_cast<int>(quarters)))
      return other;
  Fields found = search(ways_[direction].view, tool_views(scene_.grid().n).size() + direction - straight_);
  return std::move(*std::ranges::max_element(found, {}, [](const auto& field) { return field->usable_cells(); }));
}

/// Where the store knows what it finds, that.
Directions::Fields Directions::search(const ToolView& view, std::uint64_t number) const {
  Fields fields;
  if (auto known = store_.read(number)) {
    for (PostureField::Record& record : *known)
      fields.push_back(std::make_unique<PostureField>(scene_, view, std::move(record), run_.watch));
    return fields;
  }
  fields = search_anew(view, number);
  std::vector<PostureField::Record> records;
  for (const auto& field : fields) records.push_back(field->record());
  store_.write(number, records);
  return fields;
}

Directions::Fields Directions::search_anew(const ToolView& view, std::uint64_t number) const {
  // Held as from home above the stock, with some joint turned, the arm may well come from another side.
  std::vector<Configuration> known;
  const ToolView down = tool_views(scene_.grid().n)[top];
  const Vec3 above = ToolView::place(PostureLattice::hub_of(down.n, {}));
  const auto from_top = solve_ik(scene_.chain(), {down.ball_m(scene_.grid(), above), down.axis()}, home_);
  if (from_top && number != top) known.push_back(*from_top);
  return find_fields(scene_, view, home_, known, {mix(run_.seed, number), run_.helpers, run_.watch});
}

}  // namespace sculpt
