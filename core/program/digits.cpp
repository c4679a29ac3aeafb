#include "core/program/digits.hpp"

#include <algorithm>
#include <sstream>

#include "core/base/error.hpp"
#include "core/program/rounding.hpp"

namespace sculpt {
namespace {

// Three quarters of the tool's margin may be used, and 0.94 of the links', where a time law uses 0.6 and 0.75.
constexpr double alone = 1.25;

}  // namespace

Configuration Digits::axes_at(const ProgramPlace& place) const {
  Configuration axes = layout_.to_axes(place.q);
  const int decimals = facts_of(dialect_).decimals;
  if (decimals == 0) return axes;
  const DigitStray nearest = stray_at(place, layout_.to_joints(nearest_axes(layout_, axes, decimals)));
  const double tool_and_links = place.tool.stray.tool_and_links(nearest.size, nearest.tool_m);
  if (std::max({nearest.tool, nearest.links, tool_and_links}) <= alone) return axes;
  return round_axes(layout_, place.tool.rates, place.q, decimals);
}

DigitStray Digits::stray_at(const ProgramPlace& place, const Configuration& q) const {
  const ToolRates& rates = place.tool.rates;
  const Configuration off = q - place.q, size = off.cwiseAbs();
  ToolPlace tool;
  tool.put(rates, place.q);
  const double turned = rates.turn.dot(size), second = rates.orders(2) * turned * rates.travel.dot(size) / 2;
  const ToolMotion motion = tool.motion(off, rates.stickout_m);
  const double tool_m = std::max(motion.ball.norm(), motion.top.norm()) + second;
  return {size, tool_m, tool_m / certain_m(place), place.tool.stray.links(size)};
}

DigitStray Digits::check_place(const ProgramPlace& place, const Configuration& read) const {
  DigitStray stray = stray_at(place, read);
  check_share(std::max(stray.tool, stray.links), stray.tool > stray.links ? "ball or shank" : "a link", place);
  return stray;
}

void Digits::check_move(const End& from, const End& to) const {
  const Configuration size = from.second.size.cwiseMax(to.second.size);
  const double tool_m = std::max(from.second.tool_m, to.second.tool_m);
  check_share(to.first.tool.stray.tool_and_links({from.first.q, to.first.q}, size, tool_m), "the tool, to a link,",
              to.first);
}

void Digits::check_share(double share, const std::string& what, const ProgramPlace& place) const {
  if (share <= alone) return;
  std::ostringstream text;
  text.precision(3);
  text << "the digits that " << facts_of(dialect_).name << " has put " << what << ' ' << 100 * (share / alone - 1)
       << " % farther beside the plan than its certificates leave, at keyframe " << path_.edge_to(place.point).keyframe
       << ": plan with a coarser resolution, or take a dialect with more digits";
  throw InputError("rounding_too_coarse", text.str());
}

/// How far the tool may be off an edge that it goes exactly.
double Digits::certain_m(const ProgramPlace& place) const {
  if (!path_.header().mill) return place.tool.stray.tool_m();
  return std::min(place.tool.room.beside(path_.edge_to(std::max<std::size_t>(place.point, 1))),
                  place.tool.room.beside(path_.edge_to(std::min(place.point + 1, path_.size() - 1))));
}

}  // namespace sculpt
