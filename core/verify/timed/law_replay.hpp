// Plan and law -> the motion that they describe, as time polynomials: the checker's own reading of docs/timing.md.
// Internal to verify/.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/law/law_file.hpp"
#include "core/trajectory/reader.hpp"
#include "core/verify/timed/time_polynomial.hpp"

namespace sculpt {

/// Keyframe by keyframe. What is wrong with the law itself is told in `find`, with the keyframe.
class LawReplay {
 public:
  using Find = std::function<void(std::uint64_t keyframe, std::string sentence)>;

  /// Both must outlive it.
  LawReplay(TrajectoryReader& plan, const LawFile& law, Find find);

  /// The next piece of time; nothing after the last one, or where the law cannot be gone on with.
  std::optional<TimePolynomial> next();

  /// After the end: home and all keyframes, those that are where the one before them is left out.
  const std::vector<Configuration>& points() const { return points_; }
  /// Of these, where they lie by r, and their keyframes.
  const std::vector<double>& gone() const { return gone_; }
  const std::vector<std::uint64_t>& numbers() const { return numbers_; }
  /// Of a plan with milling tools: what each of them says of its tip, with the tool that is in the spindle on the way
  /// there.
  struct MillPoint {
    Vec3 tip_mm;         ///< stock frame
    int direction = -1;  ///< none: nothing is said
    int tool = 0;
    bool cut = false;
  };
  const std::vector<MillPoint>& mill() const { return mill_; }

 private:
  struct Step {
    std::uint64_t keyframe;
    Configuration to, way;
    double length, acceleration;
    bool cut;
    int tool;
  };
  std::optional<Step> read_step();
  void lay_out(const Step& step, const std::optional<Step>& next);
  bool add_part(const Step& step, double from, double size, std::array<double, 2> x);
  const LawCorner& corner(std::uint64_t keyframe) const { return law_.law.corners[keyframe - 1]; }

  TrajectoryReader& plan_;
  const LawFile& law_;
  Find find_;
  Configuration weights_, at_;
  PlanMark mark_;
  LawCorner before_;
  std::optional<Step> ahead_;
  bool started_ = false, broken_ = false;
  double time_s_ = 0, r_ = 0;
  std::vector<TimePolynomial> ready_;
  std::size_t taken_ = 0;
  std::vector<Configuration> points_;
  std::vector<double> gone_;
  std::vector<std::uint64_t> numbers_;
  std::vector<MillPoint> mill_;
  int tool_ = 0;
};

}  // namespace sculpt
