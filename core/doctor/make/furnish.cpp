#include "core/doctor/make/furnish.hpp"

#include <cstdio>
#include <numbers>

namespace sculpt {
namespace {

constexpr double disc_m = 0.02, gap_m = 0.005, floor_plate_m = 0.05;  // thicknesses; the gap is below disc and base
constexpr double post_share = 0.4;                                    // of the disc's radius

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value + 0.0);
  return text;
}

std::string triple(const Vec3& v) {
  return number(v.x()) + " " + number(v.y()) + " " + number(v.z());
}

std::string cylinder(const Vec3& middle_m, double radius_m, double length_m) {
  return "    <collision><origin xyz=\"" + triple(middle_m) + "\"/><geometry><cylinder radius=\"" + number(radius_m) +
         "\" length=\"" + number(length_m) + "\"/></geometry></collision>\n";
}

std::string box(const Vec3& middle_m, const Vec3& sides_m) {
  return "    <collision><origin xyz=\"" + triple(middle_m) + "\"/><geometry><box size=\"" + triple(sides_m) +
         "\"/></geometry></collision>\n";
}

std::string link(const std::string& name, const std::string& shapes) {
  if (shapes.empty()) return "  <link name=\"" + name + "\"/>\n";
  return "  <link name=\"" + name + "\">\n" + shapes + "  </link>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& more) {
  return "  <joint name=\"" + name + "\" type=\"" + type + "\">\n    <parent link=\"" + parent + "\"/><child link=\"" +
         child + "\"/>\n" + more + "  </joint>\n";
}

std::string origin(const Vec3& xyz, const Vec3& rpy = Vec3::Zero()) {
  return "    <origin xyz=\"" + triple(xyz) + "\"" + (rpy.isZero() ? "" : " rpy=\"" + triple(rpy) + "\"") + "/>\n";
}

/// Roll, pitch, yaw that turn z into `out`.
Vec3 turn_z_into(const Vec3& out) {
  const double pitch = std::acos(std::clamp(out.z(), -1.0, 1.0));
  const double yaw = out.head<2>().norm() < 1e-9 ? 0 : std::atan2(out.y(), out.x());
  return {0, pitch, yaw};
}

}  // namespace

FreeNames::FreeNames(const Robot& robot) {
  for (const Link& each : robot.links) taken_.insert(each.name);
  for (const Joint& each : robot.joints) taken_.insert(each.name);
}

std::string FreeNames::take(const std::string& name) {
  std::string free = name;
  for (int number = 2; !taken_.insert(free).second; ++number) free = name + "_" + std::to_string(number);
  return free;
}

SpindleText spindle_text(FreeNames& names, const std::string& flange, const Vec3& out, double radius_m,
                         double length_m) {
  SpindleText text;
  const Vec3 rpy = turn_z_into(out);
  if (length_m > 0) {
    const std::string spindle = names.take("spindle");
    text.nose = names.take("spindle_nose");
    text.elements = "  <!-- Added: the spindle, in line with the flange, and its nose, where the tool begins. -->\n" +
                    link(spindle, cylinder({0, 0, length_m / 2}, radius_m, length_m)) +
                    joint(names.take("flange_to_spindle"), "fixed", flange, spindle, origin(Vec3::Zero(), rpy)) +
                    link(text.nose, "") +
                    joint(names.take("spindle_to_nose"), "fixed", spindle, text.nose, origin({0, 0, length_m}));
  } else {
    text.nose = names.take("tool");
    text.elements = "  <!-- Added: where the tool begins, with +z out of the flange. -->\n" + link(text.nose, "") +
                    joint(names.take("flange_to_tool"), "fixed", flange, text.nose, origin(Vec3::Zero(), rpy));
  }
  return text;
}

TableText table_text(FreeNames& names, const std::string& root, const TableWish& wish) {
  TableText text;
  const std::string room = names.take("room"), disc = names.take(wish.turns ? "turntable" : "table_top");
  text.stock = names.take("stock");
  text.table_joint = names.take("table");
  std::string shapes;
  const Vec3& top = wish.top_m;
  const double post_m = top.z() - disc_m - gap_m - wish.floor_m;
  if (wish.plate)
    shapes += box({top.x() / 2, top.y() / 2, wish.floor_m - gap_m - floor_plate_m / 2},
                  {2 * wish.around_m + std::abs(top.x()), 2 * wish.around_m + std::abs(top.y()), floor_plate_m});
  if (post_m > 0) shapes += cylinder({top.x(), top.y(), wish.floor_m + post_m / 2}, post_share * wish.radius_m, post_m);
  text.elements =
      "  <!-- Added: the floor, the post of the table, its top with the frame in the middle, and the stock on it. "
      "-->\n" +
      link(room, shapes) + joint(names.take("room_to_robot"), "fixed", room, root, "") +
      link(disc, cylinder({0, 0, -disc_m / 2}, wish.radius_m, disc_m)) +
      joint(
          text.table_joint, wish.turns ? "continuous" : "fixed", room, disc,
          origin(top) + (wish.turns ? "    <axis xyz=\"0 0 1\"/>\n    <limit velocity=\"2\" effort=\"50\"/>\n" : "")) +
      link(text.stock, "") + joint(names.take("table_to_stock"), "fixed", disc, text.stock, "");
  return text;
}

}  // namespace sculpt
