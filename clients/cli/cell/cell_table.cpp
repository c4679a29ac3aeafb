#include "clients/cli/cell/cell_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace sculpt::cli {
namespace {

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

/// Without what rounds to -0.
double settled(double value) {
  return std::abs(value) < 5e-4 ? 0 : value;
}

std::string joint_value(JointKind kind, double value) {
  return kind == JointKind::prismatic ? format("%.3f m", settled(value))
                                      : format("%.1f deg", settled(value) * 180 / std::numbers::pi);
}

std::string size_text(const Vec3& size_m) {
  return format("%.3g x %.3g x %.3g m", size_m.x(), size_m.y(), size_m.z());
}

template <typename All, typename Name>
std::size_t widest(const All& all, const Name& name) {
  std::size_t width = 0;
  for (const auto& each : all) width = std::max(width, name(each).size());
  return width + 2;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string chain_lines(const CellFindings& found) {
  std::string text = format("chain: %zu joints from the stock on '%s' to the tool in '%s'\n", found.chain.size(),
                            found.stock_link.c_str(), found.tool_link.c_str());
  const std::size_t width = widest(found.chain, [](const JointFinding& joint) { return joint.name; });
  for (const JointFinding& joint : found.chain) {
    text += "  " + padded(joint.name, width) + (joint.kind == JointKind::prismatic ? "shifts  " : "turns   ") +
            padded(joint_value(joint.kind, joint.lower) + " to " + joint_value(joint.kind, joint.upper), 26) + "home " +
            joint_value(joint.kind, joint.home);
    if (joint.carries_stock) text += ", carries the stock";
    if (!joint.followers.empty()) text += ", followed by " + joined(joint.followers);
    text += "\n";
  }
  for (const IdleJoint& joint : found.idle_joints)
    text += "  " + joint.name + " lies beside it and stays at " + joint_value(joint.kind, joint.at) + "\n";
  return text;
}

std::string body_lines(const CellFindings& found) {
  std::string text = "bodies\n";
  const std::size_t width = widest(found.bodies, [](const BodyFinding& body) { return body.link; });
  for (const BodyFinding& body : found.bodies) {
    std::string what = format("%zu shape%s", body.shapes, body.shapes == 1 ? "" : "s");
    if (body.facets > 0) what += format(", %zu facets", body.facets);
    text += "  " + padded(body.link, width) + padded(what, 24) + padded(size_text(body.size_m), 26) +
            (body.moved_by.empty() ? "stands still" : "moved by " + body.moved_by) + "\n";
  }
  return text;
}

std::string pair_lines(const CellFindings& found) {
  std::string text = format("kept apart: %zu pairs of links, and all that moves from the stock; not kept apart%s\n",
                            found.checked_pairs.size(), found.unchecked_pairs.empty() ? ": none" : "");
  for (const PairFinding& pair : found.unchecked_pairs)
    text += "  " + pair.first + ", " + pair.second + ": " + pair.why + "\n";
  return text;
}

std::string home_lines(const CellFindings& found) {
  const HomeFinding& home = found.home;
  const double above = home.ball_m.z() - found.stock_size_m;
  std::string text = std::string("home: ") + (home.blocking.empty() ? "free" : "not free") +
                     format("; tool axis %.2f, %.2f, %.2f%s\n", settled(home.axis.x()), settled(home.axis.y()),
                            settled(home.axis.z()), home.axis.z() > 0.999 ? " (straight down)" : "") +
                     format("  the ball is at %.3f, %.3f, %.3f m from the stock's corner, %.3f m %s its top\n",
                            settled(home.ball_m.x()), settled(home.ball_m.y()), settled(home.ball_m.z()),
                            std::abs(above), above < 0 ? "below" : "above");
  for (const PairFinding& pair : home.blocking)
    text += "  in the way: " + pair.first + " and " + pair.second + format(", %.1f mm apart\n", 1000 * pair.gap_m);
  if (home.nearest)
    text += "  nearest: " + home.nearest->first + " and " + home.nearest->second +
            format(", %.1f mm apart\n", 1000 * home.nearest->gap_m);
  return text;
}

std::string share_of(int places, const DirectionFinding& direction) {
  return format("%4.0f %%", 100.0 * places / std::max(1, direction.places));
}

std::string reach_lines(const CellFindings& found) {
  if (found.directions.empty()) return "";
  std::string text = format(
      "reach, of %d places in the full stock (sampled; certified: the share that the sweep planner has postures for)\n"
      "  from    free   blocked  limits  too far  certified  most in the way\n",
      found.directions.front().places);
  for (const DirectionFinding& direction : found.directions) {
    text += "  " + padded(direction.name, 6) + share_of(direction.free, direction) + "   " +
            share_of(direction.blocked, direction) + "  " + share_of(direction.beyond_limits, direction) + "   " +
            share_of(direction.out_of_reach, direction) + format("     %4.0f %%", 100 * direction.field);
    if (!direction.blockers.empty())
      text += "    " + direction.blockers.front().first.first + " and " + direction.blockers.front().first.second;
    text += "\n";
  }
  return text + format("  any  %5.1f %%\n", 100 * found.reached);
}

/// As a cell file writes it, four joints a line.
std::string home_text(const JointValues& home) {
  constexpr int joints_a_line = 4;
  std::string text = "  \"home\": {";
  int joints = 0;
  for (const auto& [joint, value] : home) {
    if (joints > 0) text += joints % joints_a_line == 0 ? ",\n           " : ", ";
    text += "\"" + joint + "\": " + format("%.4f", value);
    ++joints;
  }
  return text + "}\n";
}

const char* word(Fault::Weight weight) {
  return weight == Fault::Weight::error ? "error" : weight == Fault::Weight::warning ? "warning" : "note";
}

}  // namespace

std::string fault_lines(const CellFindings& found) {
  std::string text;
  for (const Fault& fault : found.faults)
    text += std::string(word(fault.weight)) + ": " + fault.sentence + "\n  cure: " + fault.cure + "\n";
  if (found.better_home) text += "a home that is free:\n" + home_text(*found.better_home);
  return text;
}

std::string cell_line(const CellFindings& found) {
  const auto errors = std::count_if(found.faults.begin(), found.faults.end(),
                                    [](const Fault& fault) { return fault.weight == Fault::Weight::error; });
  return "cell " + found.name + ": " +
         (found.plannable() ? "ready to plan with"
                            : format("cannot be planned with, %zd error%s", errors, errors == 1 ? "" : "s")) +
         "\n";
}

std::string cell_table(const CellFindings& found) {
  std::string text = cell_line(found);
  if (found.chain.empty()) return text + fault_lines(found);
  text += chain_lines(found) + body_lines(found) + pair_lines(found) + home_lines(found) + reach_lines(found);
  text += format("tool: %.3f m from '%s' to the ball, %.3f m of it free; stock %.3f m; ball radius %.2f mm at %d^3\n",
                 found.stickout_m, found.tool_link.c_str(), found.free_length_m, found.stock_size_m,
                 1000 * found.ball_radius_m, found.resolution);
  text +=
      format("time before a plan begins: %.2f s for the scene, %.2f s for the fields\n", found.scene_s, found.fields_s);
  return text + fault_lines(found);
}

}  // namespace sculpt::cli
