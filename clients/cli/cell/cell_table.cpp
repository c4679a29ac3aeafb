#include "clients/cli/cell/cell_table.hpp"

#include <algorithm>
#include <array>
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

std::string text_of(const Json& json, const char* field) {
  return json.at(field).get<std::string>();
}

double number_of(const Json& json, const char* field) {
  return json.at(field).get<double>();
}

bool shifts(const Json& joint) {
  return joint.at("kind") == "shifts";
}

std::string joint_value(const Json& joint, const char* field) {
  const double value = settled(number_of(joint, field));
  return shifts(joint) ? format("%.3f m", value) : format("%.1f deg", value * 180 / std::numbers::pi);
}

std::string size_text(const Json& size_m) {
  return format("%.3g x %.3g x %.3g m", size_m.at(0).get<double>(), size_m.at(1).get<double>(),
                size_m.at(2).get<double>());
}

std::size_t widest(const Json& all, const char* field) {
  std::size_t width = 0;
  for (const Json& each : all) width = std::max(width, text_of(each, field).size());
  return width + 2;
}

std::string joined(const Json& names) {
  std::string text;
  for (const Json& name : names) text += (text.empty() ? "" : ", ") + name.get<std::string>();
  return text;
}

std::string two(const Json& pair, const char* between) {
  return pair.at(0).get<std::string>() + between + pair.at(1).get<std::string>();
}

std::string chain_lines(const Json& found) {
  const Json& chain = found.at("chain");
  std::string text = "chain: " + std::to_string(chain.size()) + " joints from the stock on '" +
                     text_of(found, "stock_link") + "' to the tool in '" + text_of(found, "tool_link") + "'\n";
  const std::size_t width = widest(chain, "name");
  for (const Json& joint : chain) {
    text += "  " + padded(text_of(joint, "name"), width) + (shifts(joint) ? "shifts  " : "turns   ") +
            padded(joint_value(joint, "lower") + " to " + joint_value(joint, "upper"), 26) + "home " +
            joint_value(joint, "home");
    if (joint.at("carries") == "stock") text += ", carries the stock";
    if (!joint.at("followers").empty()) text += ", followed by " + joined(joint.at("followers"));
    text += "\n";
  }
  for (const Json& joint : found.at("idle_joints"))
    text += "  " + text_of(joint, "name") + " lies beside it and stays at " + joint_value(joint, "at") + "\n";
  return text;
}

std::string body_lines(const Json& found) {
  std::string text = "bodies\n";
  const std::size_t width = widest(found.at("bodies"), "link");
  for (const Json& body : found.at("bodies")) {
    const auto shapes = body.at("shapes").get<std::size_t>(), facets = body.at("facets").get<std::size_t>();
    std::string what = format("%zu shape%s", shapes, shapes == 1 ? "" : "s");
    if (facets > 0) what += format(", %zu facets", facets);
    const std::string moved_by = text_of(body, "moved_by");
    text += "  " + padded(text_of(body, "link"), width) + padded(what, 24) + padded(size_text(body.at("size_m")), 26) +
            (moved_by.empty() ? "stands still" : "moved by " + moved_by) + "\n";
  }
  return text;
}

std::string pair_lines(const Json& found) {
  const Json& unchecked = found.at("unchecked_links");
  std::string text = format("kept apart: %zu pairs of links, and all that moves from the stock; not kept apart%s\n",
                            found.at("checked_pairs").size(), unchecked.empty() ? ": none" : "");
  for (const Json& pair : unchecked) text += "  " + two(pair.at("links"), ", ") + ": " + text_of(pair, "why") + "\n";
  return text;
}

std::string gap_line(const char* what, const Json& near) {
  return std::string("  ") + what + ": " + two(near.at("bodies"), " and ") +
         format(", %.1f mm apart\n", 1000 * number_of(near, "gap_m"));
}

std::string home_lines(const Json& found) {
  const Json& home = found.at("home");
  const auto ball_m = home.at("ball_m").get<std::array<double, 3>>();
  const auto axis = home.at("axis").get<std::array<double, 3>>();
  const double above = ball_m[2] - number_of(found, "stock_size_m");
  std::string text =
      std::string("home: ") + (home.at("free").get<bool>() ? "free" : "not free") +
      format("; tool axis %.2f, %.2f, %.2f%s\n", settled(axis[0]), settled(axis[1]), settled(axis[2]),
             axis[2] > 0.999 ? " (straight down)" : "") +
      format("  the ball is at %.3f, %.3f, %.3f m from the stock's corner, %.3f m %s its top\n", settled(ball_m[0]),
             settled(ball_m[1]), settled(ball_m[2]), std::abs(above), above < 0 ? "below" : "above");
  for (const Json& pair : home.at("blocking")) text += gap_line("in the way", pair);
  if (home.contains("nearest")) text += gap_line("nearest", home.at("nearest"));
  return text;
}

std::string share_of(const Json& direction, const char* field) {
  return format("%4.0f %%", 100 * number_of(direction, field) / std::max(1.0, number_of(direction, "places")));
}

std::string reach_lines(const Json& found) {
  const Json& directions = found.at("directions");
  if (directions.empty()) return "";
  std::string text = format(
      "reach, of %d places in the full stock (sampled; certified: the share that the sweep planner has postures for)\n"
      "  from    free   blocked  limits  too far  certified  most in the way\n",
      directions.at(0).at("places").get<int>());
  for (const Json& direction : directions) {
    text += "  " + padded(text_of(direction, "name"), 6) + share_of(direction, "free") + "   " +
            share_of(direction, "blocked") + "  " + share_of(direction, "beyond_limits") + "   " +
            share_of(direction, "out_of_reach") + format("     %4.0f %%", 100 * number_of(direction, "field"));
    if (const Json& blockers = direction.at("blockers"); !blockers.empty())
      text += "    " + two(blockers.at(0).at("bodies"), " and ");
    text += "\n";
  }
  return text + format("  any  %5.1f %%\n", 100 * number_of(found, "reached"));
}

std::string tool_line(const Json& found) {
  const Json& tool = found.at("tool");
  return format("tool: %.3f m from '", number_of(tool, "stickout_m")) + text_of(found, "tool_link") +
         format("' to the ball, %.3f m of it free; stock %.3f m; ball radius %.2f mm at %d^3\n",
                number_of(tool, "free_m"), number_of(found, "stock_size_m"), 1000 * number_of(tool, "ball_radius_m"),
                found.at("resolution").get<int>());
}

/// As a cell file writes it, four joints a line.
std::string home_text(const Json& home) {
  constexpr int joints_a_line = 4;
  std::string text = "  \"home\": {";
  int joints = 0;
  for (const auto& [joint, value] : home.items()) {
    if (joints > 0) text += joints % joints_a_line == 0 ? ",\n           " : ", ";
    text += "\"" + joint + "\": " + format("%.4f", value.get<double>());
    ++joints;
  }
  return text + "}\n";
}

}  // namespace

std::string fault_lines(const Json& found) {
  std::string text;
  for (const Json& fault : found.at("faults"))
    text += text_of(fault, "weight") + ": " + text_of(fault, "sentence") + "\n  cure: " + text_of(fault, "cure") + "\n";
  if (found.contains("better_home")) text += "a home that is free:\n" + home_text(found.at("better_home"));
  return text;
}

std::string cell_line(const Json& found) {
  const auto errors =
      std::ranges::count(found.at("faults"), "error", [](const Json& fault) { return text_of(fault, "weight"); });
  return "cell " + text_of(found, "cell") + ": " +
         (found.at("plannable").get<bool>()
              ? "ready to plan with"
              : format("cannot be planned with, %zd error%s", errors, errors == 1 ? "" : "s")) +
         "\n";
}

std::string cell_table(const Json& found) {
  std::string text = cell_line(found);
  if (found.at("chain").empty()) return text + fault_lines(found);
  text += chain_lines(found) + body_lines(found) + pair_lines(found) + home_lines(found) + reach_lines(found) +
          tool_line(found);
  const Json& seconds = found.at("seconds");
  text +=
      format("time before a plan begins: %.2f s for the scene, %.2f s for the fields%s\n", number_of(seconds, "scene"),
             number_of(seconds, "fields"), seconds.at("fields_kept").get<bool>() ? " (kept from an earlier run)" : "");
  return text + fault_lines(found);
}

}  // namespace sculpt::cli
