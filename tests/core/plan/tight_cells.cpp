// Above 300 lines: the machines and the check of plans for them, with kinematics and distances of its own.
#include "tests/core/plan/tight_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

using Move = MachinePart::Move;
using Json = nlohmann::json;

constexpr double sample_m = 5e-4, apart_at_home_m = 5e-5;

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x() << " " << v.y() << " " << v.z();
  return out.str();
}

std::string number(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

std::string link_xml(const MachinePart& part) {
  std::string xml = "<link name=\"" + part.name + "\">";
  for (const Brick& brick : part.bricks)
    xml += "<collision><origin xyz=\"" + text(brick.centre) + "\"/><geometry><box size=\"" + text(2 * brick.half) +
           "\"/></geometry></collision>";
  return xml + "</link>\n";
}

std::string joint_xml(const MachinePart& part, const std::string& parent) {
  const char* kinds[] = {"fixed", "prismatic", "revolute"};
  std::string xml = "<joint name=\"j_" + part.name + "\" type=\"" + kinds[static_cast<int>(part.joint)] +
                    "\"><parent link=\"" + parent + "\"/><child link=\"" + part.name + "\"/><origin xyz=\"" +
                    text(part.at) + "\" rpy=\"" + (part.flipped ? "3.141592653589793" : "0") + " 0 0\"/>";
  if (part.joint != Move::fixed)
    xml += "<axis xyz=\"" + text(part.axis) + "\"/><limit lower=\"" + number(part.low) + "\" upper=\"" +
           number(part.high) + "\" velocity=\"1\" effort=\"1\"/>";
  return xml + "</joint>\n";
}

/// A wall of bricks around a hole that is open upwards and downwards.
std::vector<Brick> frame_around(const Vec3& centre, double hole_half, double outer_half, double half_height) {
  const double wide = (outer_half - hole_half) / 2, off = (outer_half + hole_half) / 2;
  return {{centre + Vec3(off, 0, 0), {wide, outer_half, half_height}},
          {centre - Vec3(off, 0, 0), {wide, outer_half, half_height}},
          {centre + Vec3(0, off, 0), {hole_half, wide, half_height}},
          {centre - Vec3(0, off, 0), {hole_half, wide, half_height}}};
}

class Builder {
 public:
  Builder(std::uint64_t seed, int resolution) : random_(seed) {
    machine_.stock_m = random_.between(0.06, 0.12);
    machine_.tool_radius_m = 0.45 * machine_.stock_m / resolution;
    nose_ = machine_.stickout_m + machine_.stock_m + random_.between(0.04, 0.12);
    add_gantry();
    const bool head = chance(0.6);
    while (machine_.title.empty()) {
      if (chance(0.4)) add_plate();
      if (chance(0.4)) add_peg();
      if (chance(0.4)) add_fork();
      if (chance(0.4)) add_nest();
    }
    if (head) add_head();
  }

  TightMachine machine() && { return std::move(machine_); }

 private:
  enum : std::size_t { room, bridge, carriage, ram };

  bool chance(double share) { return random_.unit() < share; }
  MachinePart& part(std::size_t at) { return machine_.parts[at]; }
  void title(const char* what) { machine_.title += (machine_.title.empty() ? "" : ", ") + std::string(what); }

  /// Axes of half a metre or more; the ram's nose is at height `nose_` at home, right above the stock.
  void add_gantry() {
    const double reach = random_.between(0.5, 2);
    machine_.parts = {{"room", -1},
                      {"bridge", room, Move::slide, {0, 0, nose_}, false, Vec3::UnitX(), -reach, reach},
                      {"carriage", bridge, Move::slide, Vec3::Zero(), false, Vec3::UnitY(), -reach, reach},
                      {"ram", carriage, Move::slide, Vec3::Zero(), true, Vec3::UnitZ(), -0.1, 0.4}};
    part(ram).bricks = {{{0, 0, -0.5}, {0.02, 0.02, 0.5}}};
  }

  void add_plate() {
    title("ram in plate");
    const double height = nose_ + random_.between(0.02, 0.1);
    for (const Brick& brick :
         frame_around({0, 0, height}, random_.between(0.025, 0.12), 1.5, random_.between(0.004, 0.015)))
      part(room).bricks.push_back(brick);
  }

  /// Beside the ram, as long as to reach into the sleeve when the ball is down in the stock.
  void add_peg() {
    title("peg in sleeve");
    const double off = random_.between(0.16, 0.3), half = random_.between(0.005, 0.015);
    const double bottom = machine_.stickout_m - random_.between(0.02, 0.08);  // below the ram's nose
    part(ram).bricks.push_back({{off, 0, bottom / 2}, {half, half, bottom / 2}});
    part(ram).bricks.push_back({{off / 2, 0, -0.01}, {off / 2 + half, 0.01, 0.01}});
    const double hole = half + random_.between(0.005, 0.06);
    for (const Brick& brick : frame_around({off, 0, 0.03}, hole, hole + 0.02, random_.between(0.01, 0.06)))
      part(room).bricks.push_back(brick);
  }

  /// Tines on the bridge on either side of a post, so that the bridge can move by little only.
  void add_fork() {
    title("fork around post");
    const double gap = random_.between(0.0003, 0.1), y = random_.between(-0.4, 0.4);
    part(room).bricks.push_back({{0, y, nose_ + 0.5}, {0.03, 0.03, 0.05}});
    for (double side : {-1.0, 1.0})
      part(bridge).bricks.push_back({{side * (0.03 + gap + 0.01), y, 0.5}, {0.01, 0.02, 0.03}});
  }

  /// A tube on the carriage around the ram, and collars on the ram that stop at its ends.
  void add_nest() {
    title("nested slides");
    const double clear = random_.between(0.0003, 0.005), half_length = random_.between(0.02, 0.05);
    const double middle = random_.between(0.15, 0.3);
    for (const Brick& brick : frame_around({0, 0, middle}, 0.02 + clear, 0.05, half_length))
      part(carriage).bricks.push_back(brick);
    for (const Brick& brick :
         frame_around({0, 0, -(middle + half_length + random_.between(0.02, 0.3))}, 0.0199, 0.03, 0.005))
      part(ram).bricks.push_back(brick);
  }

  void add_head() {
    title("turning head");
    const bool level = chance(0.5);
    machine_.parts.push_back({"head",
                              ram,
                              Move::hinge,
                              {0, 0, level ? 0.03 : 0.005},
                              false,
                              level ? Vec3::UnitX() : Vec3::UnitZ(),
                              -1.6,
                              1.6});
    const double off = random_.between(-0.02, 0.02);
    machine_.parts.back().bricks = {{{off, 0, 0.03}, {0.02, 0.015, 0.015}}};
  }

  TightMachine machine_;
  Random random_;
  double nose_ = 0;
};

/// A brick somewhere.
struct Placed {
  Vec3 centre, half;
  Eigen::Matrix3d turn;
};

Placed place(const Frame& pose, const Brick& brick) {
  return {pose * brick.centre, brick.half, pose.linear()};
}

/// How far apart the two are along the axis that tells them apart best; below 0 if they overlap.
double gap(const Placed& a, const Placed& b) {
  double most = -1e9;
  const auto look_along = [&](const Vec3& axis) {
    if (axis.squaredNorm() < 1e-12) return;
    const Vec3 unit = axis.normalized();
    const double reach_a = (a.turn.transpose() * unit).cwiseAbs().dot(a.half);
    const double reach_b = (b.turn.transpose() * unit).cwiseAbs().dot(b.half);
    most = std::max(most, std::abs(unit.dot(b.centre - a.centre)) - reach_a - reach_b);
  };
  for (int i = 0; i < 3; ++i) {
    look_along(a.turn.col(i));
    look_along(b.turn.col(i));
    for (int j = 0; j < 3; ++j) look_along(a.turn.col(i).cross(b.turn.col(j)));
  }
  return most;
}

/// Distance from a brick to a line; the distance to something convex is convex along it.
double distance_to_line(const Placed& brick, const Vec3& from, const Vec3& to) {
  const auto distance = [&](double t) {
    const Vec3 local = brick.turn.transpose() * (from + t * (to - from) - brick.centre);
    return (local.cwiseAbs() - brick.half).cwiseMax(0).norm();
  };
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    (distance(left) < distance(right) ? high : low) = distance(left) < distance(right) ? right : left;
  }
  return distance((low + high) / 2);
}

class OverlapFinder {
 public:
  explicit OverlapFinder(const TightMachine& machine) : machine_(machine) {
    std::vector<double> home;
    for (const MachinePart& part : machine.parts) home.push_back(part.home);
    const auto at = poses(home);
    const std::size_t count = machine.parts.size();
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b)
        for (const Brick& of_a : machine.parts[a].bricks)
          for (const Brick& of_b : machine.parts[b].bricks)
            if (gap(place(at[a], of_a), place(at[b], of_b)) > apart_at_home_m) watched_.push_back({a, b, &of_a, &of_b});
  }

  /// What overlaps with the parts' joints at these values.
  std::string overlap(const std::vector<double>& values) const {
    const auto at = poses(values);
    for (const Watched& pair : watched_)
      if (const double apart = gap(place(at[pair.a], *pair.of_a), place(at[pair.b], *pair.of_b)); apart < -1e-7)
        return name(pair.a) + " and " + name(pair.b) + " overlap by " + number(-1000 * apart) + " mm";
    const Vec3 ball = at.back() * Vec3(0, 0, machine_.stickout_m);
    const Vec3 top = at.back() * Vec3(0, 0, (machine_.has_shank() ? 0.1 : 1) * machine_.stickout_m);
    for (std::size_t part = 0; part + 1 < machine_.parts.size(); ++part)
      for (const Brick& brick : machine_.parts[part].bricks)
        if (distance_to_line(place(at[part], brick), top, ball) < 0.8 * machine_.tool_radius_m)
          return "the tool is in " + name(part);
    return {};
  }

 private:
  struct Watched {
    std::size_t a, b;
    const Brick *of_a, *of_b;
  };

  const std::string& name(std::size_t part) const { return machine_.parts[part].name; }

  std::vector<Frame> poses(const std::vector<double>& values) const {
    std::vector<Frame> at;
    for (std::size_t i = 0; i < machine_.parts.size(); ++i) {
      const MachinePart& part = machine_.parts[i];
      Frame pose = part.parent < 0 ? Frame::Identity() : at[static_cast<std::size_t>(part.parent)];
      pose.translate(part.at);
      if (part.flipped) pose.rotate(Eigen::AngleAxisd(EIGEN_PI, Vec3::UnitX()));
      if (part.joint == Move::slide) pose.translate(values[i] * part.axis);
      if (part.joint == Move::hinge) pose.rotate(Eigen::AngleAxisd(values[i], part.axis));
      at.push_back(pose);
    }
    return at;
  }

  const TightMachine& machine_;
  std::vector<Watched> watched_;
};

}  // namespace

bool TightMachine::has_shank() const {
  return std::any_of(parts.begin(), parts.end(), [](const MachinePart& part) { return part.joint == Move::hinge; });
}

CellFiles TightMachine::files() const {
  CellFiles files;
  files.name = "tight";
  std::string urdf = "<robot name=\"tight\">\n";
  Json home = Json::object();
  for (const MachinePart& part : parts) {
    urdf += link_xml(part);
    if (part.parent >= 0) urdf += joint_xml(part, parts[static_cast<std::size_t>(part.parent)].name);
    if (part.joint != Move::fixed) home["j_" + part.name] = part.home;
  }
  files.files["tight.urdf"] = urdf + "</robot>\n";
  files.cell_json = Json{
      {"urdf", "tight.urdf"},
      {"stock", {{"link", parts[0].name}, {"size_m", stock_m}, {"origin_m", {-stock_m / 2, -stock_m / 2, 0}}}},
      {"tool",
       {{"link", parts.back().name},
        {"stickout_m", stickout_m},
        {"ball_radius_voxels", 0.45},
        {"shank_radius_voxels", has_shank() ? 0.4 : 0.0}}},
      {"home", home}}.dump();
  return files;
}

TightMachine random_tight_machine(std::uint64_t seed, int resolution) {
  return Builder(seed, resolution).machine();
}

std::string find_overlap(const TightMachine& machine, const std::string& trajectory) {
  const OverlapFinder finder(machine);
  std::map<std::string, std::size_t> part_of;
  std::vector<double> at;
  for (std::size_t part = 0; part < machine.parts.size(); ++part) {
    part_of["j_" + machine.parts[part].name] = part;
    at.push_back(machine.parts[part].home);
  }
  std::vector<std::size_t> moved;
  std::istringstream lines(trajectory);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    const Json json = Json::parse(line);
    ++count;
    if (json.contains("joints"))
      for (const Json& joint : json["joints"]) moved.push_back(part_of.at(joint.get<std::string>()));
    if (!json.contains("q")) continue;
    std::vector<double> to = at;
    double motion = 0;
    for (std::size_t joint = 0; joint < moved.size(); ++joint) {
      to[moved[joint]] = json["q"][joint].get<double>();
      motion += std::abs(to[moved[joint]] - at[moved[joint]]);
    }
    const int samples = 1 + static_cast<int>(motion / sample_m);
    for (int sample = 1; sample <= samples; ++sample) {
      std::vector<double> between = at;
      for (std::size_t part = 0; part < at.size(); ++part) between[part] += (to[part] - at[part]) * sample / samples;
      if (const std::string what = finder.overlap(between); !what.empty())
        return "line " + std::to_string(count) + ", sample " + std::to_string(sample) + " of " +
               std::to_string(samples) + ": " + what;
    }
    at = to;
  }
  return {};
}

}  // namespace sculpt
