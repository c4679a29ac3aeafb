// The part as it is seen along each direction.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "core/mill/finish/facet_columns.hpp"

namespace sculpt {

/// Made when first asked for; of small parts they are kept. Any thread.
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
    if (part_.triangles.size() <= max_kept) kept_[direction] = made;
    return made;
  }

 private:
  /// Triangles; each takes about 150 bytes a direction.
  static constexpr std::size_t max_kept = 100000;

  const Mesh& part_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<const FacetColumns>> kept_;
};

}  // namespace sculpt
