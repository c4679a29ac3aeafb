// The tool directions of a sweep, and the field of configurations of each.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/sweep/field/posture_field.hpp"
#include "core/sweep/reach/reach_rows.hpp"
#include "core/sweep/stock_turn.hpp"

namespace sculpt {

/// By number: the straight ones (tool_views), then the tilted ones. Fields are found when they are first asked for; not
/// shared between threads.
class Directions {
 public:
  /// `scene` must outlive the object.
  Directions(const Scene& scene, const Configuration& home, const RunContext& run);

  /// The fields of all straight directions. To be called first. Throws Cancelled.
  void find_straight_fields();

  /// The coordinate that turns the stock under the arm, if there is one.
  std::optional<int> stock_turn() const { return turn_ ? std::optional(turn_->coordinate) : std::nullopt; }

  std::size_t straight() const { return straight_; }
  std::size_t size() const { return views_.size(); }
  const ToolView& view(std::size_t direction) const { return views_[direction]; }
  /// Throws Cancelled.
  const PostureField& field(std::size_t direction);
  /// The tilted directions whose fields were found.
  std::vector<std::size_t> tilted_found() const;
  /// Which of them has this field, one that was found.
  std::size_t number_of(const PostureField& field) const;
  /// Where the field of a straight direction is usable.
  const ReachRows& reach(std::size_t direction) const { return *reach_[direction]; }
  /// May the ball's centre be at this cell, for links and limits? True where the field is not known.
  bool may_reach(std::size_t direction, const Vec3& cell) const {
    return !fields_[direction] || fields_[direction]->usable(cell);
  }

 private:
  void find(std::size_t direction);
  std::unique_ptr<PostureField> search(std::size_t direction) const;
  std::unique_ptr<PostureField> turned(const PostureField& field, std::size_t direction, double quarters) const;

  const Scene& scene_;
  Configuration home_;
  RunContext run_;
  std::optional<StockTurn> turn_;
  std::vector<ToolView> views_;
  std::size_t straight_ = 0;
  std::vector<std::unique_ptr<PostureField>> fields_;
  std::vector<std::optional<ReachRows>> reach_;
};

}  // namespace sculpt
