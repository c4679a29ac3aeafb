// Above 300 lines: a program by itself, so that nothing of it can be shared with what it judges.
// Does a trajectory touch anything, or remove what it does not come to? Asked of dense samples, with nothing of the
// planner's or the replay's code: own kinematics, own shapes, points on the surfaces of what moves, looked up in what
// they may not be in.
//   mutant_sampler CELL.json TRAJECTORY.ndjson [FIRST LAST]     exit 0: free, 1: something overlaps, 2: it cannot say
// FIRST, LAST: only these lines of the file are looked at, the header is line 1.
// For cells of boxes, cylinders and spheres whose whole grid is clamped. It cannot prove that a trajectory is free:
// what lies between its samples it does not see.
#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::json;
using Vec = Eigen::Vector3d;
using Pose = Eigen::Isometry3d;

constexpr double deep_m = 1e-5;             // overlaps less deep than this are not told
constexpr double deep_voxels = 1e-3;        // of the tool in a voxel
constexpr double link_points_m = 0.008;     // between points of a link's surface
constexpr double tool_points_voxels = 0.4;  // along the shank
constexpr std::size_t max_points = 3000;    // of a shape, to look whether it is in another one
constexpr std::size_t max_lines = 1'000'000'000;
constexpr double step_voxels = 0.15;  // that a point of the tool moves between samples

Vec numbers(const char* text, const Vec& otherwise) {
  if (text == nullptr) return otherwise;
  std::istringstream in(text);
  Vec v;
  if (!(in >> v[0] >> v[1] >> v[2])) throw std::runtime_error(std::string("no three numbers: ") + text);
  return v;
}

Pose origin(const tinyxml2::XMLElement* element) {
  Pose pose = Pose::Identity();
  const auto* at = element->FirstChildElement("origin");
  if (at == nullptr) return pose;
  pose.translation() = numbers(at->Attribute("xyz"), Vec::Zero());
  const Vec rpy = numbers(at->Attribute("rpy"), Vec::Zero());
  pose.linear() = (Eigen::AngleAxisd(rpy.z(), Vec::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec::UnitY()) *
                   Eigen::AngleAxisd(rpy.x(), Vec::UnitX()))
                      .toRotationMatrix();
  return pose;
}

/// A box, or a body of revolution about z between two radii (a sphere: `ball`).
struct Solid {
  enum class Kind { box, cone, ball } kind = Kind::box;
  Pose pose = Pose::Identity();
  Vec half = Vec::Zero();    // box; z also of a cone
  double low = 0, high = 0;  // radii at both ends
  std::vector<Vec> points;   // on the surface, in the link
  double reach = 0;          // from the middle to the farthest point

  /// How deep a point of the link is inside; negative outside.
  double depth(const Vec& at) const {
    const Vec p = pose.inverse() * at;
    switch (kind) {
      case Kind::box:
        return (half - p.cwiseAbs()).minCoeff();
      case Kind::ball:
        return low - p.norm();
      case Kind::cone: {
        const double share = (p.z() + half.z()) / (2 * half.z()), radius = low + share * (high - low);
        return std::min(half.z() - std::abs(p.z()), radius - p.head<2>().norm());
      }
    }
    return -1;
  }

  void add_points() {
    const auto add = [&](const Vec& p) {
      points.push_back(pose * p);
      reach = std::max(reach, p.norm());
    };
    const auto ring = [&](double z, double radius) {
      const int count = std::max(6, static_cast<int>(2 * std::numbers::pi * radius / link_points_m));
      for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * k / count;
        add({radius * std::cos(angle), radius * std::sin(angle), z});
      }
    };
    if (kind == Kind::box) {
      for (int face = 0; face < 3; ++face) {
        const int u = (face + 1) % 3, v = (face + 2) % 3;
        const int nu = 1 + static_cast<int>(2 * half[u] / link_points_m),
                  nv = 1 + static_cast<int>(2 * half[v] / link_points_m);
        for (int side : {-1, 1})
          for (int a = 0; a <= nu; ++a)
            for (int b = 0; b <= nv; ++b) {
              Vec p;
              p[face] = side * half[face];
              p[u] = half[u] * (2.0 * a / nu - 1);
              p[v] = half[v] * (2.0 * b / nv - 1);
              add(p);
            }
      }
    } else if (kind == Kind::ball) {
      const int rings = std::max(6, static_cast<int>(std::numbers::pi * low / link_points_m));
      for (int r = 0; r <= rings; ++r) {
        const double angle = std::numbers::pi * r / rings;
        ring(low * std::cos(angle), low * std::sin(angle));
      }
    } else {
      const int rings = 1 + static_cast<int>(2 * half.z() / link_points_m);
      for (int r = 0; r <= rings; ++r) {
        const double share = static_cast<double>(r) / rings;
        ring(half.z() * (2 * share - 1), low + share * (high - low));
      }
      for (const double z : {-half.z(), half.z()})
        for (double radius = z < 0 ? low : high; radius > 0; radius -= link_points_m) ring(z, radius);
    }
  }
};

struct Joint {
  std::string name;
  int parent = -1, child = -1;
  enum class Kind { fixed, turn, slide } kind = Kind::fixed;
  Pose at = Pose::Identity();
  Vec axis = Vec::UnitX();
  int coordinate = -1;
  double rest = 0;
};

struct Link {
  std::string name;
  std::vector<Solid> solids;
};

class Machine {
 public:
  explicit Machine(const std::filesystem::path& path) {
    std::ifstream in(path);
    cell = Json::parse(in);
    tinyxml2::XMLDocument urdf;
    const auto file = path.parent_path() / cell.at("urdf").get<std::string>();
    if (urdf.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) throw std::runtime_error("no URDF: " + file.string());
    const auto* robot = urdf.FirstChildElement("robot");
    for (const auto* e = robot->FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) add_link(e);
    for (const auto* e = robot->FirstChildElement("joint"); e != nullptr; e = e->NextSiblingElement("joint"))
      add_joint(e);
    put_parents_first();
    stock = find(cell.at("stock").at("link"));
    tool = find(cell.at("tool").at("link"));
    add_holder();
    for (Link& link : links)
      for (Solid& solid : link.solids) solid.add_points();
    for (int pass = 0; pass < static_cast<int>(joints.size()); ++pass)
      for (const Joint& joint : joints)
        if (joint.kind == Joint::Kind::fixed) group[joint.child] = group[joint.parent];
    for (const auto& pair : cell.value("ignore_pairs", Json::array()))
      ignored.insert(std::minmax(find(pair.at(0)), find(pair.at(1))));
    // Joints that are no coordinates stand where home says.
    const Json home = cell.value("home", Json::object());
    for (Joint& joint : joints)
      if (home.contains(joint.name)) joint.rest = home.at(joint.name);
  }

  int find(const std::string& name) const {
    for (std::size_t at = 0; at < links.size(); ++at)
      if (links[at].name == name) return static_cast<int>(at);
    throw std::runtime_error("no link " + name);
  }

  void name_coordinates(const std::vector<std::string>& names) {
    for (std::size_t c = 0; c < names.size(); ++c)
      for (Joint& joint : joints)
        if (joint.name == names[c]) joint.coordinate = static_cast<int>(c);
  }

  /// Of all links, in the root.
  std::vector<Pose> place(const std::vector<double>& q) const {
    std::vector<Pose> poses(links.size(), Pose::Identity());
    for (const Joint& joint : joints) {
      const double value = joint.coordinate < 0 ? joint.rest : q[static_cast<std::size_t>(joint.coordinate)];
      Pose move = Pose::Identity();
      if (joint.kind == Joint::Kind::turn) move.linear() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
      if (joint.kind == Joint::Kind::slide) move.translation() = value * joint.axis;
      poses[static_cast<std::size_t>(joint.child)] = poses[static_cast<std::size_t>(joint.parent)] * joint.at * move;
    }
    return poses;
  }

  Json cell;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<int> group;
  std::set<std::pair<int, int>> ignored;
  int stock = -1, tool = -1;

 private:
  void add_link(const tinyxml2::XMLElement* element) {
    Link link{element->Attribute("name"), {}};
    for (const auto* e = element->FirstChildElement("collision"); e != nullptr;
         e = e->NextSiblingElement("collision")) {
      const auto* geometry = e->FirstChildElement("geometry");
      Solid solid;
      solid.pose = origin(e);
      if (const auto* box = geometry->FirstChildElement("box")) {
        solid.half = numbers(box->Attribute("size"), Vec::Zero()) / 2;
      } else if (const auto* cylinder = geometry->FirstChildElement("cylinder")) {
        solid.kind = Solid::Kind::cone;
        solid.low = solid.high = cylinder->DoubleAttribute("radius");
        solid.half.z() = cylinder->DoubleAttribute("length") / 2;
      } else if (const auto* sphere = geometry->FirstChildElement("sphere")) {
        solid.kind = Solid::Kind::ball;
        solid.low = sphere->DoubleAttribute("radius");
      } else {
        throw std::runtime_error("link " + link.name + " has a shape that is none of box, cylinder and sphere");
      }
      link.solids.push_back(solid);
    }
    group.push_back(static_cast<int>(links.size()));
    links.push_back(link);
  }

  void add_joint(const tinyxml2::XMLElement* element) {
    Joint joint;
    joint.name = element->Attribute("name");
    joint.parent = find(element->FirstChildElement("parent")->Attribute("link"));
    joint.child = find(element->FirstChildElement("child")->Attribute("link"));
    joint.at = origin(element);
    if (const auto* axis = element->FirstChildElement("axis"))
      joint.axis = numbers(axis->Attribute("xyz"), Vec::UnitX()).normalized();
    if (element->FirstChildElement("mimic") != nullptr) throw std::runtime_error("mimic joints are not known here");
    const std::string type = element->Attribute("type");
    if (type == "revolute" || type == "continuous") joint.kind = Joint::Kind::turn;
    if (type == "prismatic") joint.kind = Joint::Kind::slide;
    joints.push_back(joint);
  }

  void put_parents_first() {
    std::vector<bool> placed(links.size(), true);
    for (const Joint& joint : joints) placed[static_cast<std::size_t>(joint.child)] = false;
    for (std::size_t done = 0; done < joints.size(); ++done)
      for (std::size_t at = done; at < joints.size(); ++at)
        if (placed[static_cast<std::size_t>(joints[at].parent)]) {
          std::swap(joints[done], joints[at]);
          placed[static_cast<std::size_t>(joints[done].child)] = true;
          break;
        }
  }

  void add_holder() {
    double start = 0;
    for (const Json& section : cell.at("tool").value("holder", Json::array())) {
      Solid solid;
      solid.kind = Solid::Kind::cone;
      solid.low = section.at("radius_m");
      solid.high = section.value("end_radius_m", solid.low);
      const double length = section.at("length_m");
      solid.half.z() = length / 2;
      solid.pose.translation().z() = start + length / 2;
      start += length;
      links[static_cast<std::size_t>(tool)].solids.push_back(solid);
    }
  }
};

using Cell = std::array<int, 3>;

class Sampler {
 public:
  Sampler(Machine& machine, std::istream& in) : machine_(machine), in_(in) {
    const Json header = read();
    names_ = header.at("joints").get<std::vector<std::string>>();
    machine_.name_coordinates(names_);
    at_ = header.at("home").get<std::vector<double>>();
    n_ = header.at("resolution");
    tolerance_ = header.at("tolerance_m");
    const Json& stock = machine.cell.at("stock");
    voxel_ = stock.at("size_m").get<double>() / n_;
    for (int axis = 0; axis < 3; ++axis) origin_[axis] = stock.at("origin_m").at(static_cast<std::size_t>(axis));
    const Json& tool = machine.cell.at("tool");
    const bool by_voxels = tool.contains("ball_radius_voxels");
    const double unit = by_voxels ? voxel_ : 1;
    const std::string name = by_voxels ? "_radius_voxels" : "_radius_m";
    ball_ = tool.at("ball" + name).get<double>() * unit;
    shank_ = tool.value("shank" + name, 0.0) * unit;
    stickout_ = tool.value("stickout_m", 0.0);
    standing_.assign(static_cast<std::size_t>(n_) * n_ * n_, true);
    add_tool_points();
    choose_pairs();
  }

  /// What overlaps first; empty if nothing does.
  std::string run(std::size_t first_line, std::size_t last_line) {
    for (std::size_t line = 2;; ++line) {
      const Json step = read();
      if (step.at("type") == "end") return {};
      const auto to = step.at("q").get<std::vector<double>>();
      std::vector<Cell> run;
      if (step.at("type") == "cut") run = cells(step.at("voxels"));
      if (line >= first_line && line <= last_line) {
        const std::string found = look_along(to, run);
        if (!found.empty()) return "line " + std::to_string(line) + ": " + found;
      }
      for (const Cell& cell : run) standing_[index(cell)] = false;
      at_ = to;
    }
  }

 private:
  struct Pair {
    int a, b;
  };

  Json read() {
    std::string line;
    if (!std::getline(in_, line)) throw std::runtime_error("the trajectory has no end");
    return Json::parse(line);
  }

  static std::vector<Cell> cells(const Json& ends) {
    Cell at = ends.at(0).get<Cell>(), last = ends.at(1).get<Cell>();
    std::vector<Cell> run{at};
    while (at != last) {
      for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += (last[axis] > at[axis]) - (last[axis] < at[axis]);
      run.push_back(at);
    }
    return run;
  }

  void add_tool_points() {
    for (int r = 0; r <= 8; ++r)
      for (int k = 0; k < 16; ++k) {
        const double up = std::numbers::pi * r / 8, round = 2 * std::numbers::pi * k / 16;
        tool_points_.push_back(Vec(0, 0, stickout_) + ball_ * Vec(std::sin(up) * std::cos(round),
                                                                  std::sin(up) * std::sin(round), std::cos(up)));
      }
    if (shank_ <= 0 || stickout_ <= 0) return;
    const int rings = 1 + static_cast<int>(stickout_ / (tool_points_voxels * voxel_));
    for (int r = 0; r <= rings; ++r)
      for (int k = 0; k < 10; ++k) {
        const double round = 2 * std::numbers::pi * k / 10;
        tool_points_.emplace_back(shank_ * std::cos(round), shank_ * std::sin(round), stickout_ * r / rings);
      }
  }

  int group(int link) const { return machine_.group[static_cast<std::size_t>(link)]; }

  /// Those that are not of one piece, nor neighbours across a joint, nor let off by the cell, nor overlap at home.
  void choose_pairs() {
    std::set<std::pair<int, int>> neighbours;
    for (const Joint& joint : machine_.joints) neighbours.insert(std::minmax(group(joint.parent), group(joint.child)));
    const std::vector<Pose> home = machine_.place(at_);
    const int count = static_cast<int>(machine_.links.size());
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b) {
        const Pair pair{a, b};
        if (group(a) == group(b) || neighbours.count(std::minmax(group(a), group(b))) > 0) continue;
        if (machine_.ignored.count({a, b}) > 0 || overlap(pair, home)) continue;
        pairs_.push_back(pair);
      }
  }

  const Link& link(int at) const { return machine_.links[static_cast<std::size_t>(at)]; }

  static bool points_inside(const std::vector<Vec>& points, const Pose& to_other, const Solid& other) {
    for (const Vec& point : points)
      if (other.depth(to_other * point) > deep_m) return true;
    return false;
  }

  bool overlap(const Pair& pair, const std::vector<Pose>& poses) const {
    const Pose to_b = poses[static_cast<std::size_t>(pair.b)].inverse() * poses[static_cast<std::size_t>(pair.a)],
               to_a = to_b.inverse();
    for (const Solid& one : link(pair.a).solids)
      for (const Solid& other : link(pair.b).solids) {
        if ((to_b * one.pose.translation() - other.pose.translation()).norm() > one.reach + other.reach) continue;
        // Points of a table's top among those of a wrist are many, and none is told by them alone.
        if (one.points.size() <= max_points && points_inside(one.points, to_b, other)) return true;
        if (other.points.size() <= max_points && points_inside(other.points, to_a, one)) return true;
      }
    return false;
  }

  std::string look_along(const std::vector<double>& to, const std::vector<Cell>& run) {
    const double way = tool_way(to);
    const std::size_t parts = std::max<std::size_t>(1, run.size());
    const int samples = 1 + static_cast<int>(way / (step_voxels * voxel_ * static_cast<double>(parts)));
    std::vector<double> q(to.size());
    for (std::size_t part = 0; part < parts; ++part) {
      if (!run.empty()) standing_[index(run[part])] = false;  // the voxel being cut may be touched
      for (int sample = 1; sample <= samples; ++sample) {
        const double t =
            (static_cast<double>(part) + static_cast<double>(sample) / samples) / static_cast<double>(parts);
        for (std::size_t c = 0; c < q.size(); ++c) q[c] = at_[c] + t * (to[c] - at_[c]);
        std::string found = look(q);
        if (!found.empty()) return found + " at " + std::to_string(100 * t) + " % of the motion";
      }
      if (!run.empty() && !ball_is_in(run[part], q)) return "the ball is not where it removes a voxel";
    }
    return {};
  }

  bool ball_is_in(const Cell& cell, const std::vector<double>& q) const {
    const Vec centre = origin_ + voxel_ * Vec(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5);
    return (tool_in_stock(machine_.place(q)) * Vec(0, 0, stickout_) - centre).norm() <= tolerance_ + deep_m;
  }

  /// How far ball and top of the tool go at most, seen from the stock, by a few samples.
  double tool_way(const std::vector<double>& to) const {
    double ball = 0, top = 0;
    std::optional<Pose> before;
    std::vector<double> q(to.size());
    for (int sample = 0; sample <= 8; ++sample) {
      for (std::size_t c = 0; c < q.size(); ++c) q[c] = at_[c] + sample / 8.0 * (to[c] - at_[c]);
      const Pose tool = tool_in_stock(machine_.place(q));
      if (before) {
        ball += (tool * Vec(0, 0, stickout_) - *before * Vec(0, 0, stickout_)).norm();
        top += (tool.translation() - before->translation()).norm();
      }
      before = tool;
    }
    return std::max(ball, top);
  }

  Pose tool_in_stock(const std::vector<Pose>& poses) const {
    return poses[static_cast<std::size_t>(machine_.stock)].inverse() * poses[static_cast<std::size_t>(machine_.tool)];
  }

  std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell[0] + n_ * (cell[1] + n_ * cell[2]));
  }

  bool in_material(const Vec& in_stock, double deep) const {
    const Vec at = (in_stock - origin_) / voxel_;
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] <= deep || at[axis] >= n_ - deep) return false;
      cell[static_cast<std::size_t>(axis)] = static_cast<int>(at[axis]);
      const double share = at[axis] - std::floor(at[axis]);
      if (share < deep || share > 1 - deep) return false;
    }
    return standing_[index(cell)];
  }

  bool comes_to_the_grid(const Vec& in_stock, double reach) const {
    const Vec middle = origin_ + Vec::Constant(n_ * voxel_ / 2);
    return (((in_stock - middle).cwiseAbs().array() - n_ * voxel_ / 2).max(0.0)).matrix().norm() <= reach;
  }

  std::string look(const std::vector<double>& q) const {
    const std::vector<Pose> poses = machine_.place(q);
    const Pose tool = tool_in_stock(poses), from_root = poses[static_cast<std::size_t>(machine_.stock)].inverse();
    for (const Vec& point : tool_points_)
      if (in_material(tool * point, deep_voxels)) return "the tool is in the material";
    const int stock_group = group(machine_.stock), tool_group = group(machine_.tool);
    for (std::size_t at = 0; at < machine_.links.size(); ++at) {
      const Pose in_stock = from_root * poses[at],
                 to_link = poses[at].inverse() * poses[static_cast<std::size_t>(machine_.tool)];
      const int of = machine_.group[at];
      for (const Solid& solid : machine_.links[at].solids) {
        if (of != stock_group && comes_to_the_grid(in_stock * solid.pose.translation(), solid.reach))
          for (const Vec& point : solid.points)
            if (in_material(in_stock * point, deep_m / voxel_))
              return link(static_cast<int>(at)).name + " is in the material";
        const Vec middle = to_link * Vec(0, 0, stickout_ / 2);
        const bool apart =
            (middle - solid.pose.translation()).norm() > solid.reach + stickout_ / 2 + std::max(ball_, shank_);
        if (of != tool_group && !apart && points_inside(tool_points_, to_link, solid))
          return "the tool is in " + link(static_cast<int>(at)).name;
      }
    }
    for (const Pair& pair : pairs_)
      if (overlap(pair, poses)) return link(pair.a).name + " is in " + link(pair.b).name;
    return {};
  }

  Machine& machine_;
  std::istream& in_;
  std::vector<std::string> names_;
  std::vector<double> at_;
  int n_ = 0;
  double voxel_ = 0, tolerance_ = 0, ball_ = 0, shank_ = 0, stickout_ = 0;
  Vec origin_ = Vec::Zero();
  std::vector<bool> standing_;
  std::vector<Vec> tool_points_;
  std::vector<Pair> pairs_;
};

}  // namespace

int main(int count, char** words) {
  if (count != 3 && count != 5) {
    std::cerr << "usage: mutant_sampler CELL.json TRAJECTORY.ndjson [FIRST LAST]\n";
    return 2;
  }
  try {
    Machine machine{std::filesystem::path(words[1])};
    std::ifstream in(words[2]);
    const bool some = count == 5;
    const std::string found =
        Sampler(machine, in).run(some ? std::stoul(words[3]) : 2, some ? std::stoul(words[4]) : max_lines);
    std::cout << (found.empty() ? "free" : found) << "\n";
    return found.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "mutant_sampler: " << error.what() << "\n";
    return 2;
  }
}
