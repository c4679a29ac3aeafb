#include "core/program/write/ros2.hpp"

#include <cmath>

#include "core/program/write/number_format.hpp"
#include "core/timing/motion/motion_pieces.hpp"

namespace sculpt {
namespace {

constexpr int decimals = 8;
constexpr double min_s = 1e-6;  // between points: times are whole nanoseconds and must rise

void append_list(std::string& text, const char* name, const Configuration& values) {
  text += name;
  for (Eigen::Index at = 0; at < values.size(); ++at) {
    if (at > 0) text += ", ";
    append_fixed(text, values[at], decimals);
  }
  text += "]\n";
}

}  // namespace

ProgramReport write_ros2(const PlanPath& path, const Cell& cell, const ProgramDemands& demands,
                         const std::function<void(const ProgramFile&)>& take) {
  const TimedPlan plan = time_plan(path, cell, demands.motion);
  std::string text = "# trajectory_msgs/msg/JointTrajectory; rad, m and seconds\njoint_names: [";
  for (std::size_t at = 0; at < path.header().joints.size(); ++at)
    text += (at > 0 ? ", " : "") + path.header().joints[at];
  text += "]\npoints:\n";
  ProgramReport report;
  double last_s = -1;
  const auto add = [&](double time_s, const Configuration& q, const Configuration& velocity) {
    if (time_s < last_s + min_s) return;
    last_s = time_s;
    append_list(text, "  - positions: [", q);
    append_list(text, "    velocities: [", velocity);
    const double seconds = std::floor(time_s);
    const auto nanoseconds = std::min(999'999'999ll, std::llround((time_s - seconds) * 1e9));
    text += "    time_from_start: {sec: " + std::to_string(static_cast<long long>(seconds)) +
            ", nanosec: " + std::to_string(nanoseconds) + "}\n";
    ++report.moves;
  };
  const Configuration home = path.configuration(0);
  add(0, home, Configuration::Zero(home.size()));
  MotionPieces pieces(path, plan.law);
  MotionPiece piece;
  double end_s = 0;
  while (pieces.next(piece)) {
    end_s = piece.end_s();
    add(end_s, piece.q(piece.seconds), piece.velocity(piece.seconds));
  }
  report.seconds = end_s;
  report.parts = report.files = 1;
  report.bytes = text.size();
  take({demands.name + ".yaml", std::move(text)});
  return report;
}

}  // namespace sculpt
