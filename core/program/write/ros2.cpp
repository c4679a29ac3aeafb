#include "core/program/write/ros2.hpp"

#include <cmath>

#include "core/program/write/number_format.hpp"
#include "core/timing/motion/motion_pieces.hpp"

namespace sculpt {
namespace {

constexpr int ros2_decimals = 8;
constexpr double min_s = 1e-6;  // between points: times are whole nanoseconds and must rise

void append_list(std::string& text, const char* name, const Configuration& values) {
  text += name;
  for (Eigen::Index at = 0; at < values.size(); ++at) {
    if (at > 0) text += ", ";
    append_fixed(text, values[at], ros2_decimals);
  }
  text += "]\n";
}

/// One trajectory; times count from its own start.
class Ros2File {
 public:
  Ros2File(const std::vector<std::string>& joints, const std::optional<ToolMount>& mount) {
    text_ = "# trajectory_msgs/msg/JointTrajectory; rad, m and seconds\n";
    if (mount) text_ += "# " + mount->text() + "\n";
    text_ += "joint_names: [";
    for (std::size_t at = 0; at < joints.size(); ++at) text_ += (at > 0 ? ", " : "") + joints[at];
    text_ += "]\npoints:\n";
  }

  bool add(double time_s, const Configuration& q, const Configuration& velocity) {
    if (time_s < last_s_ + min_s) return false;
    last_s_ = time_s;
    append_list(text_, "  - positions: [", q);
    append_list(text_, "    velocities: [", velocity);
    const double seconds = std::floor(time_s);
    const auto nanoseconds = std::min(999'999'999ll, std::llround((time_s - seconds) * 1e9));
    text_ += "    time_from_start: {sec: " + std::to_string(static_cast<long long>(seconds)) +
             ", nanosec: " + std::to_string(nanoseconds) + "}\n";
    return true;
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  double last_s_ = -1;
};

std::optional<ToolMount> mount_of(const PlanPath& path, std::size_t tool) {
  if (!path.header().mill) return {};
  const MillTool& one = path.header().mill->tools[tool];
  return ToolMount{one.number, one.name};
}

}  // namespace

ProgramReport write_ros2(const PlanPath& path, const Cell& cell, const ProgramDemands& demands,
                         const std::function<void(const ProgramFile&)>& take) {
  const TimedPlan plan = time_plan(path, cell, demands.motion);
  ProgramReport report;
  const auto tools = path.header().mill ? path.edge_to(path.size() - 1).tool : 0;
  std::size_t tool = 0;
  Ros2File file(path.header().joints, mount_of(path, tool));
  const auto hand_out = [&] {
    std::string text = file.take();
    report.bytes += text.size();
    ++report.files;
    take({tools == 0 ? demands.name + ".yaml" : ProgramNames{demands.name, tool + 1, 0, {}}.part_name() + ".yaml",
          std::move(text)});
  };
  const Configuration home = path.configuration(0), still = Configuration::Zero(home.size());
  report.moves += file.add(0, home, still);
  MotionPieces pieces(path, plan.law);
  MotionPiece piece;
  double begin_s = 0, end_s = 0;
  while (pieces.next(piece)) {
    if (const std::size_t now = path.edge_to(piece.point).tool; now != tool) {  // at rest there
      hand_out();
      tool = now;
      begin_s = end_s;
      file = Ros2File(path.header().joints, mount_of(path, tool));
      report.moves += file.add(0, piece.at, still);
    }
    end_s = piece.end_s();
    report.moves += file.add(end_s - begin_s, piece.q(piece.seconds), piece.velocity(piece.seconds));
  }
  hand_out();
  report.seconds = end_s;
  report.parts = report.files;
  return report;
}

}  // namespace sculpt
