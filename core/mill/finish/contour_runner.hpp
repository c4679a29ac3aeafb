// Leads the cutter along contours in one direction, one after the other.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/carver.hpp"
#include "core/mill/drive/air_ways.hpp"
#include "core/mill/finish/contour_strokes.hpp"
#include "core/mill/finish/envelope.hpp"

namespace sculpt {

/// As a tour has them; where the robot cannot go on so, from where it can. Not shared between threads.
class ContourRunner {
 public:
  /// All must outlive it. The carver has entered the direction. `spacing_m`: of rows.
  ContourRunner(const MillJob& job, Carver& carver, const RunContext& run, const Site& site,
                const EnvelopeTask& envelope, double spacing_m)
      : job_(job), carver_(carver), run_(run), site_(site), envelope_(envelope), spacing_m_(spacing_m) {}

  /// Draws back at the end. Contours that it finds no way to are left out. Throws Cancelled.
  void run(std::vector<Contour> tour);

 private:
  /// How the tip may go from one contour to another.
  struct Ways {
    double min_height;  ///< of those over (tool frame)
    double beside_m;    ///< along the surface, from no farther away
    bool by_air;        ///< from the hub, where no straight way over leads
  };
  /// A contour of a batch, and which of its strokes was the first one for it.
  struct Laid {
    Contour contour;
    std::size_t begin;
    bool is_by_air;  ///< it was gone to through the air
  };
  struct Batch {
    std::vector<MillStroke> strokes;
    std::vector<Laid> contours;  ///< in the order of their strokes
    std::vector<Contour> apart;  ///< that the robot does not come to
  };
  struct BatchesDone {
    Batch batch, ahead;    ///< the last one that the arm began with, and the one after it
    std::size_t done = 0;  ///< strokes of the last one
  };
  /// Where a tour may be gone on with: at the beginning or the end of a contour.
  struct Entry {
    double far2;
    std::size_t number;
    bool is_back;
  };

  void find_air_ways();
  std::vector<Contour> carry_out(const Ways& ways, std::vector<Contour> contours);
  BatchesDone follow_batches(const Ways& ways, std::vector<Contour>& contours, ContourStrokes& laid,
                             std::vector<Contour>& apart);
  Batch lay_batch(const Ways& ways, std::vector<Contour>& contours, ContourStrokes& laid) const;
  bool lay_next(const Ways& ways, std::vector<Contour>& contours, ContourStrokes& laid, Batch& batch) const;
  /// To where the contours begin: along the surface, through the air, or straight over where both are empty.
  struct Course {
    Contour way;
    std::vector<Vec3> air;
  };
  bool turn_to_next(const Ways& ways, std::vector<Contour>& contours, const ContourStrokes& laid, Course& course) const;
  std::optional<Entry> find_next(const Ways& ways, const std::vector<Contour>& contours, const ContourStrokes& laid,
                                 Course& course) const;
  std::optional<Entry> find_begin(const Ways& ways, const std::vector<Contour>& contours, const Vec3& at,
                                  Course& course) const;
  static const Vec3& place_of(const std::vector<Contour>& contours, const Entry& entry);
  static const Vec3& end_of_tour(const std::vector<Contour>& contours, const Entry& begin);
  static std::vector<Entry> nearest_entries(const Vec3& at, const std::vector<Contour>& contours, std::size_t most);
  bool comes_over(const Ways& ways, const Vec3& from, const Vec3& to) const;

  const MillJob& job_;
  Carver& carver_;
  const RunContext& run_;
  const Site& site_;
  const EnvelopeTask& envelope_;
  double spacing_m_;
  std::unique_ptr<const AirWays> air_;
  std::vector<Vec3> refused_;  ///< legs through the air ended there that the arm did not follow
};

}  // namespace sculpt
