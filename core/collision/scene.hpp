// The cell with its material at one moment of the carving: is a configuration free, is an edge free all along.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/collision/bubble.hpp"
#include "core/collision/contact.hpp"
#include "core/collision/link_pairs.hpp"
#include "core/collision/material.hpp"
#include "core/collision/near_bodies.hpp"
#include "core/collision/shape/body.hpp"

namespace sculpt {

class SceneBodies;

/// Owns a copy of the cell's kinematics and shapes and of the standing material. Const calls are safe from several
/// threads, `remove` is not.
class Scene {
 public:
  /// `cell` must outlive the scene.
  Scene(const Cell& cell, const Grid& grid, const VoxelSet& standing);
  ~Scene();

  const Chain& chain() const;
  const Grid& grid() const;
  const Tool& tool() const;
  const Material& material() const;
  /// `v` stands no longer.
  void remove(Voxel v);
  /// Only `left`, a part of what stood, stands any longer.
  void leave(const VoxelSet& left);

  /// Could the tool alone come down its own axis to `pose` (stock frame)? True if a cylinder of the larger of ball's
  /// and shank's radius, from the ball's centre along the shank, is clear of all material but `exempt`. Exact.
  bool tool_fits(const ToolPose& pose, std::optional<Voxel> exempt) const;

  /// Contacts at q. The tool (not the links) may touch `exempt`.
  Contact contact_at(const Configuration& q, std::optional<Voxel> exempt = {}) const;

  /// Links that may touch each other, at least with some of their shapes, and why.
  const std::vector<UncheckedLinks>& unchecked_links() const;

  /// Configurations that were tested so far, for links or for the tool: what collision checking costs.
  std::uint64_t checks() const;

  /// The first contact at q as a person would say it, e.g. "'link5' touches the stock", with the cure where it is two
  /// links; empty if there is none.
  std::string describe_contact(const Configuration& q) const;

  /// Of the bodies that must stay apart those that are nearer than `within_m` (m), or too near, at q; joint limits are
  /// not looked at.
  std::vector<NearBodies> near_bodies(const Configuration& q, double within_m) const;
  /// The first two that are too near at q, but for the tool in the stock; their gap is not measured.
  std::optional<NearBodies> blocking_links(const Configuration& q) const;

  /// Pairs of bodies, or of a body and the material, by number.
  using Pairs = std::vector<std::size_t>;
  /// Those that bubbles are about: links with the material, the room and each other, and the tool with links that can
  /// move against the stock. Not tool with material or with what stands still in the stock's frame.
  Pairs pairs() const;
  /// Of these, those that may touch somewhere in `box`; of which the same part counts as for `bubble`.
  Pairs pairs_in(const JointBox& box) const;

  /// Finds out which pairs may touch somewhere in `box`: of an edge within it no others are looked at from now on. Not
  /// for several threads.
  void settle(const JointBox& box);

  /// The stock as it stood when the scene was made, as what links are kept clear of.
  const Body& full_stock() const;
  /// The same of what stands of it: `blocks` are those of a coarser grid in which anything does.
  Body stock_of(const VoxelSet& blocks) const;

  /// Of the configurations in `box`, those at which surely none of `pairs` touch, `stock` standing; it holds q and all
  /// of `wanted`, or it is empty. Beyond the limits of what shifts it holds none, other limits are not looked at. `q`,
  /// `wanted`: in the box. Pairs that touch nowhere in the box are taken out: its parts need not ask for them. Stays
  /// true while material is removed.
  Bubble bubble(const Configuration& q, const JointBox& box, const std::vector<Configuration>& wanted,
                const Body& stock, Pairs& pairs) const;

  /// Is the box [low_m, high_m] of the stock's frame clear of all links that stand still in that frame?
  bool room_is_clear(const Vec3& low_m, const Vec3& high_m) const;

  /// Certifies the joint-linear edge from `from` to `to` at every point between, not at samples: `none` only if it is
  /// free. May refuse an edge that passes closer than the margins (0.2 mm for links, 0.005 voxel for the tool). The
  /// tool may touch `exempt`.
  Contact certify(const Configuration& from, const Configuration& to, std::optional<Voxel> exempt = {}) const;
  /// The same of an edge on which the n voxels of `run` are removed, the m-th while the m-th n-th part is gone through:
  /// the tool may touch no more of them than that one and those before. True only if each part is free; may refuse what
  /// is, above all where the tool turns.
  bool certify_run(const Configuration& from, const Configuration& to, const VoxelLine& run) const;

 private:
  std::unique_ptr<SceneBodies> bodies_;
};

}  // namespace sculpt
