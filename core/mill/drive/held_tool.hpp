// A cell with one milling tool in its spindle, and how its robot holds it in each direction.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/collision/scene.hpp"
#include "core/mill/map/assembly.hpp"
#include "core/mill/map/tool_frame.hpp"
#include "core/sweep/field/posture_field.hpp"
#include "core/sweep/stock_turn.hpp"

namespace sculpt {

/// A cube of coarse cells around the stock, as wide as the tip may go: what fields of postures are laid over. `room_m`:
/// around the stock, at least.
Grid grid_around(const Grid& stock, double room_m);
/// The cells of `around` that hold any of the whole stock's cube.
VoxelSet cells_of(const Grid& stock, const Grid& around);
/// The same of those of its voxels that stand.
VoxelSet cells_of(const VoxelSet& standing, const Grid& stock, const Grid& around);

/// Scenes for one tool. Reads are safe from several threads once fields were found.
class HeldTool {
 public:
  /// `cell` must outlive the object. `around`: of the stock.
  HeldTool(const Cell& cell, const MillTool& tool, const Grid& stock, const Grid& around);

  const Assembly& assembly() const { return assembly_; }
  const Grid& around() const { return around_; }
  /// Links, and what is fixed to the tool link with the tool, against everything: for ways outside the stock.
  const Scene& carrying() const { return *carrying_scene_; }

  using Fields = std::vector<std::unique_ptr<PostureField>>;
  /// The fields of a direction, that together cover much, links held against what stands; none where the robot cannot
  /// hold the tool so. Replaced by the next call for it; one call at a time. Throws Cancelled.
  const Fields& fields(const Direction& direction, const Configuration& home, const RunContext& run);
  /// Only these cells of `around` hold anything of the stock from now on.
  void see(const VoxelSet& cells);

  /// A place of the stock frame in cells of the field's view.
  static Vec3 cell_of(const PostureField& field, const Grid& around, const Vec3& point);

 private:
  struct Quarters;
  /// What a search gave that suits a direction and its quarter turns best.
  struct Found {
    Fields fields;    ///< against the full stock
    int quarter = 0;  ///< that they are for
  };

  Fields find_turned(const Direction& direction, const Configuration& home, const RunContext& run);
  Fields search(const Direction& direction, const ToolView& view, const Configuration& home,
                const RunContext& run) const;
  Found search(const Quarters& quarters, const Configuration& home, const RunContext& run) const;

  Assembly assembly_;
  Grid around_;
  Cell carried_, guided_;
  std::unique_ptr<Scene> carrying_scene_;
  Scene guided_scene_;
  std::optional<StockTurn> turn_;
  VoxelSet cells_;
  std::map<Direction, Found> found_;  ///< by the first of the four directions
  struct Opened {
    Fields fields;
    VoxelSet standing;  ///< cells that they were opened for
  };
  std::map<Direction, Opened> opened_;
};

}  // namespace sculpt
