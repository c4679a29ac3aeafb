#include "core/sweep/field/bubble_cover.hpp"

#include <algorithm>
#include <utility>

#include "core/collision/margins.hpp"

namespace sculpt {
namespace {

constexpr double limit_margin = 0.002;  // rad or m: exact configurations differ from interpolated ones
/// Ball and shank, off their line by all that path_tolerance allows, stay within this of it, whatever their radii.
constexpr double tool_room_voxels = 0.5 - tool_margin_voxels;
constexpr int largest = 8;  // cubes that are tried first, in parts

/// What a bubble for a cube must hold: a little more than all corners in it, those between nodes only in cubes smaller
/// than a cell.
struct Wanted {
  Configuration centre;
  std::vector<Configuration> corners;  ///< none if one is missing or near a limit
  JointBox box;                        ///< around them
};

Wanted find_wanted(const PostureLattice& lattice, const LatticeCube& cube) {
  // Exact configurations differ a little from interpolated ones, and edges pass from one bubble to the next, so more is
  // asked for than is needed.
  constexpr double more = 1.08;
  const Chain& chain = lattice.chain();
  Wanted wanted{
      lattice.guess(lattice.middle_cell(cube.corner, cube.size)), lattice.find_corners(cube.corner, cube.size), {}};
  if (wanted.corners.empty()) return wanted;
  JointBox hull{wanted.corners.front(), wanted.corners.front()};
  for (const Configuration& q : wanted.corners) hull = {hull.low.cwiseMin(q), hull.high.cwiseMax(q)};
  if (!chain.within_limits(hull.low, -limit_margin) || !chain.within_limits(hull.high, -limit_margin)) return {};
  for (Configuration& q : wanted.corners) q = wanted.centre + more * (q - wanted.centre);
  const Configuration half = more * hull.reach_from(wanted.centre) + Configuration::Constant(chain.dof(), 1e-6);
  wanted.box = {wanted.centre - half, wanted.centre + half};
  return wanted;
}

}  // namespace

/// Covers one of the cubes that are tried first.
class BubbleCover::Search {
 public:
  Search(const BubbleCover& whole, const Making& making, int smallest, const VoxelSet* wanted)
      : whole_(whole),
        scene_(making.scene),
        stock_(making.stock),
        lattice_(making.lattice),
        watch_(making.watch),
        smallest_(smallest),
        wanted_(wanted) {}

  /// Covers a cube by one bubble if there is one, else by parts as small as `smallest_`. `room`: for the tool is known.
  void cover(LatticeCube cube, bool room) {
    if (watch_.stop.stop_requested()) throw Cancelled{};
    if (wanted_ != nullptr && !lacks_wanted(cube)) return;
    const bool has_all = lattice_.has_nodes(cube.corner, cube.size);
    if (cube.size <= PostureLattice::parts && !has_all) return;
    room = room || has_room(cube.corner, cube.size);
    if (const Wanted wanted = has_all ? find_wanted(lattice_, cube) : Wanted{}; !wanted.corners.empty()) {
      if (Bubble bubble = find_bubble(wanted, cube); !bubble.empty()) {
        bubbles.emplace_back(std::move(bubble), find_places(cube, room));
        return;
      }
    }
    if (cube.size == smallest_) {
      holes.push_back(std::move(cube));
      return;
    }
    const int half = cube.size / 2;
    for (int child = 0; child < 8; ++child)
      cover({cube.corner + Voxel{child & 1, child >> 1 & 1, child >> 2} * half, half, cube.box, cube.pairs}, room);
  }

  /// Bubbles and the usable parts that each of them is for.
  std::vector<std::pair<Bubble, std::vector<Voxel>>> bubbles;
  std::vector<LatticeCube> holes;

 private:
  bool lacks_wanted(const LatticeCube& cube) const {
    for (int k = 0; k < cube.size; ++k)
      for (int j = 0; j < cube.size; ++j)
        for (int i = 0; i < cube.size; ++i) {
          const Voxel part = cube.corner + Voxel{i, j, k};
          if (wanted_->contains(part) && whole_.bubble_[PostureLattice::index_of(part)] < 0) return true;
        }
    return false;
  }

  /// A bubble in the box of what is wanted; empty if there is none. The cube's surroundings become those of the bubble.
  Bubble find_bubble(const Wanted& wanted, LatticeCube& cube) const {
    if (!cube.box.holds(wanted.box)) {
      cube.box = whole_.box_;
      cube.pairs = whole_.pairs_;
    }
    if (!cube.box.holds(wanted.box)) return {};
    cube.box = wanted.box;
    return scene_.bubble(wanted.centre, wanted.box, wanted.corners, stock_, cube.pairs);
  }

  /// Where there is room for the tool.
  std::vector<Voxel> find_places(const LatticeCube& cube, bool room) const {
    std::vector<Voxel> places;
    for (int k = 0; k < cube.size; ++k)
      for (int j = 0; j < cube.size; ++j)
        for (int i = 0; i < cube.size; ++i) {
          const Voxel place = cube.corner + Voxel{i, j, k};
          if (room || has_room(place, 1)) places.push_back(place);
        }
    return places;
  }

  /// For all ball positions in the cube that can occur: they are centres of voxels, or above, so that none is nearer to
  /// a side of the grid than half a voxel.
  bool has_room(Voxel corner, int size) const {
    const Vec3 first = lattice_.corner_cell(corner).cwiseMax(0);
    const Vec3 last = lattice_.corner_cell(corner + Voxel{1, 1, 1} * size).cwiseMin(lattice_.last_cell());
    return (first.array() > last.array()).any() || tool_has_room(scene_, lattice_, first, last, tool_room_voxels);
  }

  const BubbleCover& whole_;
  const Scene& scene_;
  const Body& stock_;
  const PostureLattice& lattice_;
  const Watch& watch_;
  int smallest_;
  const VoxelSet* wanted_;  ///< parts; null for all
};

BubbleCover::BubbleCover(const Making& making)
    : bubble_(PostureLattice::all_parts(), -1), box_(making.lattice.bounds()) {
  if (box_.low.size() > 0) pairs_ = making.scene.pairs_in(box_);
  cover(making, max_cubes(), PostureLattice::parts);
}

std::vector<LatticeCube> BubbleCover::max_cubes() const {
  std::vector<LatticeCube> cubes;
  for (int k = 0; k < PostureLattice::fine; k += largest)
    for (int j = 0; j < PostureLattice::fine; j += largest)
      for (int i = 0; i < PostureLattice::fine; i += largest) cubes.push_back({{i, j, k}, largest, box_, pairs_});
  return cubes;
}

void BubbleCover::refine(const Making& making) {
  cover(making, std::exchange(holes_, {}), 1);
}

void BubbleCover::extend(const Making& making, const VoxelSet& wanted) {
  cover(making, max_cubes(), 1, &wanted);
  holes_.clear();
}

void BubbleCover::turn(const Configuration& turn) {
  for (Bubble& bubble : bubbles_) bubble.shift(turn);
  box_ = box_.shifted(turn);
  holes_.clear();
}

void BubbleCover::cover(const Making& making, const std::vector<LatticeCube>& cubes, int smallest,
                        const VoxelSet* wanted) {
  std::vector<Search> found(cubes.size(), Search(*this, making, smallest, wanted));
  making.helpers.for_each_index(cubes.size(), [&](std::size_t at) { found[at].cover(cubes[at], false); });
  for (Search& one : found) {
    for (auto& [bubble, places] : one.bubbles) {
      if (places.empty()) continue;
      for (Voxel place : places) bubble_[PostureLattice::index_of(place)] = static_cast<std::int32_t>(bubbles_.size());
      bubbles_.push_back(std::move(bubble));
    }
    holes_.insert(holes_.end(), one.holes.begin(), one.holes.end());
  }
  close_upwards(making.lattice.view().lean);
}

/// What can be come to can be left along the axis: a cell under one that may not be used may not be used either. A
/// tilted axis leads through cells that share an edge or a corner, so all those around it count.
void BubbleCover::close_upwards(Voxel lean) {
  constexpr int fine = PostureLattice::fine;
  usable_bubble_ = bubble_;
  usable_ = PostureLattice::all_parts();
  if (std::ranges::find(bubble_, -1) == bubble_.end()) return;
  std::vector<Voxel> above;
  for (int part = 1; part < 8; ++part) {
    const Voxel up{part & 1, part >> 1 & 1, part >> 2};
    if (up.i <= lean.i && up.j <= lean.j && up.k <= lean.k) above.push_back(up);
  }
  const auto usable_or_outside = [&](Voxel cell) {
    return std::max({cell.i, cell.j, cell.k}) >= fine || is_usable(cell);
  };
  for (int k = fine - 1; k >= 0; --k)
    for (int j = fine - 1; j >= 0; --j)
      for (int i = fine - 1; i >= 0; --i)
        for (const Voxel up : above)
          if (!usable_or_outside(Voxel{i, j, k} + up)) usable_bubble_[PostureLattice::index_of({i, j, k})] = -1;
  usable_ = static_cast<std::size_t>(
      std::count_if(usable_bubble_.begin(), usable_bubble_.end(), [](int id) { return id >= 0; }));
}

bool tool_has_room(const Scene& scene, const PostureLattice& lattice, const Vec3& first, const Vec3& last,
                   double room_voxels) {
  const Vec3 a = lattice.ball_m(first), b = lattice.ball_m(last),
             reach = scene.tool().stickout_m * lattice.view().axis();
  const double radius = room_voxels * lattice.grid().voxel_m;
  const Vec3 low = a.cwiseMin(b).cwiseMin(a + reach).cwiseMin(b + reach) - Vec3::Constant(radius);
  const Vec3 high = a.cwiseMax(b).cwiseMax(a + reach).cwiseMax(b + reach) + Vec3::Constant(radius);
  return scene.room_is_clear(low, high);
}

}  // namespace sculpt
