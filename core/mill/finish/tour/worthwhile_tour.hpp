// Contours that finish a part of the surface -> a tour of what of them is worth the way.
#pragma once

#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/finish/cut_preview.hpp"
#include "core/mill/finish/envelope.hpp"

namespace sculpt {

struct TourTask {
  double spacing_m = 0;     ///< of rows
  double worth = 0;         ///< for a length of row that is finished, so many times as long a path is worth it
  bool is_trimmed = false;  ///< without what is not worth it at their ends; so they need not begin above what stands
  const EnvelopeTask& envelope;
};

struct WorthwhileTour {
  std::vector<Contour> contours;
  std::vector<char> finishes;  ///< each nail, or not
};

/// `preview`: of nothing cut yet. Throws Cancelled.
WorthwhileTour worthwhile_tour(const TourTask& task, std::vector<Contour> contours, const CutPreview& preview,
                               const RunContext& run);

}  // namespace sculpt
