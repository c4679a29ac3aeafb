// Bubbles over the parts of a lattice of postures: where a tool direction is certified free for links.
//
// A cube of parts is covered by one bubble if the bubble holds the configurations at all its nodes, else by cubes of
// half the size, down to single cells of the lattice (refine: to parts of them):
//
//      +-------+---+---+     8 parts along an edge: tried first
//      |       | B | C |     A: one bubble of 4 x 4 parts
//      |   A   +---+---+     B, C, D: 2 x 2 parts each; one bubble may serve several
//      |       | D | x |     x: no bubble (a link is too near to the pedestal, say): a hole
//      +-------+---+---+
//
// The ball comes and goes along the tool's axis, so a part under a hole cannot be used either.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/helpers.hpp"
#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"
#include "core/sweep/field/posture_lattice.hpp"

namespace sculpt {

/// A cube of parts of the lattice, and what may touch in a box of joint values around it.
struct LatticeCube {
  Voxel corner;
  int size;
  JointBox box;
  Scene::Pairs pairs;
};

/// Every part that may be used lies in a bubble: there no link touches anything, whatever is carved from then on. Made
/// for one lattice. Reads are safe from several threads.
class BubbleCover {
 public:
  /// Covers nothing.
  BubbleCover() = default;

  /// What it is made from, and by. It only has to live during the calls.
  struct Making {
    const Scene& scene;
    const Body& stock;  ///< of the scene: what stands
    const PostureLattice& lattice;
    const Helpers& helpers;
    const Watch& watch;
  };

  /// Throws Cancelled.
  explicit BubbleCover(const Making& making);

  /// Tries again, in finer parts, where no bubble was found. Slow where there is none. Throws Cancelled.
  void refine(const Making& making);
  /// Looks for bubbles at those of the `wanted` parts that have none, down to single parts. Throws Cancelled.
  void extend(const Making& making, const VoxelSet& wanted);
  /// For a lattice that was turned.
  void turn(const Configuration& turn);

  /// Parts that may be used.
  std::size_t usable_parts() const { return usable_; }
  bool is_usable(Voxel part) const { return usable_bubble_[PostureLattice::index_of(part)] >= 0; }
  /// The number of the part's bubble; -1 where it may not be used.
  std::int32_t bubble_of(Voxel part) const { return usable_bubble_[PostureLattice::index_of(part)]; }
  const Bubble& bubble(std::int32_t number) const { return bubbles_[static_cast<std::size_t>(number)]; }
  /// All configurations of the lattice.
  const JointBox& bounds() const { return box_; }

  /// For FieldStore.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(bubble_, usable_bubble_, bubbles_, box_, pairs_, holes_, usable_);
  }

 private:
  class Search;
  std::vector<LatticeCube> max_cubes() const;
  /// `wanted`: parts; null for all.
  void cover(const Making& making, const std::vector<LatticeCube>& cubes, int smallest,
             const VoxelSet* wanted = nullptr);
  void close_upwards(Voxel lean);

  std::vector<std::int32_t> bubble_;         ///< per part: index into bubbles_, or -1
  std::vector<std::int32_t> usable_bubble_;  ///< the same of those that may be used
  std::vector<Bubble> bubbles_;
  JointBox box_;                    ///< around all nodes
  Scene::Pairs pairs_;              ///< what may touch in it
  std::vector<LatticeCube> holes_;  ///< where no bubble was found, as small as was tried
  std::size_t usable_ = 0;
};

/// Is there room around the tool by `room_voxels` (voxel edges), for all ball positions in a box of cells?
bool tool_has_room(const Scene& scene, const PostureLattice& lattice, const Vec3& first, const Vec3& last,
                   double room_voxels);

}  // namespace sculpt
