// The part as it is seen along each direction.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "core/mill/finish/facet_columns.hpp"

namespace sculpt {

/// Made when first asked for, and kept while there is room: directions are gone through again and again, so which of a
/// fine mesh are kept does not matter. Any thread.
class PartViews {
 public:
  /// `part` must outlive the object. `count`: of directions.
  explicit PartViews(const Mesh& part, std::size_t count) : part_(part), kept_(count) {}

  std::shared_ptr<const FacetColumns> along(std::size_t direction, const ToolFrame& frame) {
    {
      const std::lock_guard lock(mutex_);
      if (kept_[direction]) return kept_[direction];
    }
    auto made = std::make_shared<const FacetColumns>(part_, frame);
    const std::lock_guard lock(mutex_);
    if (const std::size_t size = made->bytes(); !kept_[direction] && bytes_ + size <= max_bytes) {
      kept_[direction] = made;
      bytes_ += size;
    }
    return made;
  }

 private:
  /// Of a part of 100 000 triangles all are kept.
  static constexpr std::size_t max_bytes = std::size_t{400} << 20;

  const Mesh& part_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<const FacetColumns>> kept_;
  std::size_t bytes_ = 0;  ///< of those
};

}  // namespace sculpt
