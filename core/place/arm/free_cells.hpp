// Two bodies that one or two joints move against each other: cells of the joints' ranges in which they surely do not
// touch, found out as they are asked for.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "core/cell/chain.hpp"
#include "core/collision/shape/body.hpp"

namespace sculpt {

/// What it answers depends on the configuration only, not on what was asked before or by whom. Any thread.
class FreeCells {
 public:
  /// The bodies must outlive the object and stay where they are.
  FreeCells(const Chain& chain, const Body& first, const Body& second, double margin_m);

  /// False where they are moved by more joints than two, or ranges are too long: then nothing can be asked.
  bool is_usable() const { return cells_ != nullptr; }

  /// Are they more than the margin apart at q, and at all configurations whose two joints are in the same cell?
  /// `chain`: any in which the same joints move the two.
  bool is_free(const Chain& chain, const Configuration& q) const;

 private:
  enum State : std::uint8_t { unknown, free, not_sure };
  struct Axis {
    Eigen::Index coordinate;
    double low;
    int cells;
  };

  State look(const Chain& chain, Configuration q) const;

  const Body &first_, &second_;
  double reach_m_ = 0;  ///< the margin, and what the two move within half a cell
  std::vector<Axis> axes_;
  std::unique_ptr<std::atomic<std::uint8_t>[]> cells_;
};

}  // namespace sculpt
