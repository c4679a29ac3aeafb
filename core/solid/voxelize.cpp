#include "core/solid/voxelize.hpp"

#include <sstream>

#include "core/material/voxel_rows.hpp"
#include "core/solid/find_crossings.hpp"
#include "core/solid/holes.hpp"
#include "core/solid/shells.hpp"

namespace sculpt {
namespace {

/// A solid with small holes stays far below (Stanford bunny, holes in its base: 2 to 4 %), a hemisphere shell is at
/// 50 %, a cube without one side at 33 %.
constexpr double odd_share_limit = 0.2;
constexpr double dispute_share_limit = 0.2;
/// Above this share of columns the turn of facets that no neighbour confirms is no better than chance.
constexpr double unbalanced_share_limit = 0.05;

struct Vote {
  VoxelSet inside;
  std::uint64_t enclosed = 0;  ///< voxels inside
  std::uint64_t disputed = 0;  ///< voxels on which trusted axes disagree
};

using Axes = std::array<Crossings, 3>;

/// What one axis says about a chunk of a row, and which voxels of it lie in columns that can be trusted.
struct Voice {
  std::uint64_t inside, trusted;
};

/// Columns of y are named (z, x) and so lie across a row: their odd bits are gathered by x first. Result: bit i + n k.
std::vector<std::uint64_t> odd_by_x(const Crossings& y_axis, int n) {
  std::vector<std::uint64_t> odd(y_axis.odd.size());
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const std::size_t at = i + static_cast<std::size_t>(n) * k;
      if (y_axis.is_odd(k + static_cast<std::size_t>(n) * i)) odd[at >> 6] |= std::uint64_t{1} << (at & 63);
    }
  }
  return odd;
}

/// Majority of the trusted axes; a tie, or no trusted axis, is outside.
std::uint64_t majority(const std::array<Voice, 3>& voices, std::uint64_t& disputed) {
  std::uint64_t any_yes = 0, any_no = 0, pair_yes = 0, pair_no = 0;
  for (const Voice& voice : voices) {
    const std::uint64_t yes = voice.inside & voice.trusted, no = ~voice.inside & voice.trusted;
    pair_yes |= any_yes & yes;
    pair_no |= any_no & no;
    any_yes |= yes;
    any_no |= no;
  }
  disputed = any_yes & any_no;
  return (any_yes & ~any_no) | (pair_yes & ~pair_no);
}

Vote take_vote(const Axes& axes, int n, const Watch& watch) {
  Vote vote{VoxelSet(n)};
  const VoxelRows rows(n);
  const std::vector<std::uint64_t> y_odd = odd_by_x(axes[1], n);
  const auto chunk_of = [&](const std::vector<std::uint64_t>& bits, int chunk, int row) {
    const std::size_t at = static_cast<std::size_t>(chunk) * rows.width + static_cast<std::size_t>(n) * row;
    return (bits[at >> 6] >> (at & 63)) & rows.mask();
  };
  for (int k = 0; k < n; ++k) {
    watch.step(Stage::voxelize, k, n);
    for (int j = 0; j < n; ++j) {
      const bool row_odd = axes[0].is_odd(j + static_cast<std::size_t>(n) * k);
      for (int c = 0; c < rows.chunks; ++c) {
        std::uint64_t disputed = 0;
        const std::uint64_t inside =
            majority({{{rows.get(axes[0].inside, j, k, c), row_odd ? 0 : rows.mask()},
                       {rows.get(axes[1].inside, j, k, c), rows.mask() & ~chunk_of(y_odd, c, k)},
                       {rows.get(axes[2].inside, j, k, c), rows.mask() & ~chunk_of(axes[2].odd, c, j)}}},
                     disputed);
        vote.enclosed += static_cast<std::uint64_t>(std::popcount(inside));
        vote.disputed += static_cast<std::uint64_t>(std::popcount(disputed));
        rows.put(vote.inside, j, k, c, inside);
      }
    }
  }
  return vote;
}

std::uint64_t count(const std::vector<std::uint64_t>& words) {
  std::uint64_t sum = 0;
  for (std::uint64_t word : words) sum += static_cast<std::uint64_t>(std::popcount(word));
  return sum;
}

/// Where the surface is open: the number of holes, and place and size of the longest.
std::string describe_holes(const FixedMesh& mesh, const Grid& grid) {
  std::vector<Hole> holes = find_holes(mesh, find_open_edges(sort_sides(mesh.triangles, mesh.vertices.size())));
  if (holes.empty()) return "";
  const auto longest = std::ranges::max_element(holes, {}, &Hole::length);
  const double mm = 1000 * grid.voxel_m / (1 << unit_bits);
  const Vec3 at = mm * longest->box.center() + 1000 * grid.origin_m;
  std::ostringstream text;
  text.precision(4);
  text << "; " << holes.size() << (holes.size() == 1 ? " hole" : " holes") << ", the largest "
       << mm * longest->box.diagonal().norm() << " mm across, around (" << at.x() << ", " << at.y() << ", " << at.z()
       << ") mm of the stock's frame, as the mesh is placed";
  return text.str();
}

/// How far the columns of three axes can be trusted.
struct Shares {
  std::uint64_t met = 0, odd = 0, unbalanced = 0;
  double odd_share() const { return share(odd); }
  double unbalanced_share() const { return share(unbalanced); }

 private:
  double share(std::uint64_t columns) const {
    return met == 0 ? 0 : static_cast<double>(columns) / static_cast<double>(met);
  }
};

[[noreturn]] void refuse(const std::string& why, const Shares& shares, const std::string& holes) {
  std::ostringstream text;
  text.precision(3);
  text << "the mesh is not a solid: " << why << " (" << 100 * shares.odd_share()
       << " % of the columns that meet its surface are inconsistent, limit " << 100 * odd_share_limit << " %" << holes
       << "): close its surface in a mesh editor";
  throw InputError("mesh_not_solid", text.str());
}

Shares find_crossings(const Surface& surface, int n, Axes& axes, const Watch& watch) {
  Shares shares;
  for (int axis = 0; axis < 3; ++axis) {
    axes[axis] = find_crossings(surface, n, axis, watch);
    shares.met += count(axes[axis].met);
    shares.odd += count(axes[axis].odd);
    shares.unbalanced += axes[axis].unbalanced;
  }
  return shares;
}

std::string percent_of(std::uint64_t part, std::uint64_t all) {
  std::ostringstream text;
  text.precision(3);
  text << 100 * static_cast<double>(part) / static_cast<double>(all) << " %";
  return text.str();
}

}  // namespace

Solid find_solid(const Mesh& mesh, const Grid& grid, const Watch& watch) {
  Surface surface = turn_shells(to_fixed(mesh, grid));
  Axes axes;
  Shares shares = find_crossings(surface, grid.n, axes, watch);
  const auto holes = [&] { return describe_holes(surface.mesh, grid); };
  if (shares.odd_share() > odd_share_limit) refuse("its surface is open", shares, holes());
  const bool chance = shares.unbalanced_share() > unbalanced_share_limit;
  if (chance) {
    for (std::size_t facet = 0; facet < surface.role.size(); ++facet)
      if (surface.sheet[facet]) surface.role[facet] = Role::unturned;
    shares = find_crossings(surface, grid.n, axes, watch);
  }
  Vote vote = take_vote(axes, grid.n, watch);
  if (vote.enclosed == 0)
    refuse("it encloses no voxel centre, so it is either open or thinner than a voxel; raise the resolution", shares,
           holes());
  const auto limit = static_cast<std::uint64_t>(dispute_share_limit * static_cast<double>(vote.enclosed));
  if (vote.disputed > limit)
    refuse("x, y and z columns disagree on what is inside, by " + percent_of(vote.disputed, vote.enclosed) +
               " of its volume",
           shares, holes());
  const Ambiguous& ambiguous =
      std::ranges::max_element(axes, {}, [](const Crossings& axis) { return axis.ambiguous.voxels; })->ambiguous;
  if (chance && ambiguous.voxels > limit)
    refuse("its facets are turned at random, and even and odd crossings disagree with them on " +
               percent_of(ambiguous.voxels, vote.enclosed) + " of its volume",
           shares, holes());
  return {std::move(vote.inside), ambiguous};
}

}  // namespace sculpt
