#include "clients/cli/place/place_table.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "clients/cli/place/formatted.hpp"

namespace sculpt::cli {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

const std::string& link_name(const Cell& cell, int link) {
  return cell.robot.links[static_cast<std::size_t>(link)].name;
}

std::string row(const PlaceReport& report, std::size_t at) {
  const RatedStand& one = report.rated[at];
  const Share& share = one.share;
  const auto of_all = [&](std::uint64_t voxels) { return percent(voxels, share.removable); };
  const Stand& stand = one.stand;
  std::string notes = stand == report.own ? " now" : "";
  if (one.reach.is_blocked) notes += " stands in something";
  if (!one.reach.home_is_free) notes += " home touches";
  const std::string certified =
      at < report.certified.size()
          ? formatted("%10.2f", percent(report.certified[at].held, report.certified[at].removable))
          : "         -";
  return formatted("%5zu %8.3f %8.3f %8.3f %7.1f %8.3f %8.3f  %7.2f%s  %6.2f %6.2f %6.2f %6.2f %6.2f", at + 1,
                   stand.at_m.x(), stand.at_m.y(), stand.at_m.z(), stand.turn_rad * degrees, stand.height_m,
                   stand.stickout_m, of_all(share.held), certified.c_str(), of_all(share.tool), of_all(share.stock),
                   of_all(share.links), of_all(share.limits), of_all(share.reach)) +
         notes + "\n";
}

/// The best share that was found at each x and y, whatever the rest.
std::string map_text(const PlaceReport& report) {
  std::map<std::pair<double, double>, double> best;  // by y, x
  std::set<double> xs, ys;
  for (const RatedStand& one : report.rated) {
    const double x = one.stand.at_m.x(), y = one.stand.at_m.y();
    xs.insert(x);
    ys.insert(y);
    best.try_emplace({y, x}, percent(one.share.held, one.share.removable));
  }
  if (xs.size() * ys.size() < 2) return "";
  std::string text = "\nestimate in % at x (across) and y (down), the best of all else\n   y \\ x";
  for (const double x : xs) text += formatted("%8.3f", x);
  text += "\n";
  for (auto y = ys.rbegin(); y != ys.rend(); ++y) {
    text += formatted("%8.3f", *y);
    for (const double x : xs) {
      const auto at = best.find({*y, x});
      text += at == best.end() ? "       ." : formatted("%8.2f", at->second);
    }
    text += "\n";
  }
  return text;
}

std::string turn_over_text(const PlaceReport& report) {
  if (report.turn_overs.empty()) return "";
  std::string text =
      formatted("\nTogether with a second clamping at rank %zu, the mesh turned (estimate in %%):\n", report.best + 1);
  for (const TurnOver& turn : report.turn_overs)
    text += formatted("  %-24s --rotate %g,%g,%g%*s %7.2f\n", turn.name.c_str(), turn.rotate_deg.x(),
                      turn.rotate_deg.y(), turn.rotate_deg.z(), 4, "", percent(turn.share.held, turn.share.removable));
  return text;
}

nlohmann::ordered_json share_json(const Share& share) {
  return {{"removable", share.removable}, {"held", share.held},
          {"tool", share.tool},           {"stock", share.stock},
          {"links", share.links},         {"limits", share.limits},
          {"reach", share.reach},         {"held_along", share.held_along}};
}

nlohmann::ordered_json stand_json(const RatedStand& one) {
  const Stand& stand = one.stand;
  return {{"at_m", {stand.at_m.x(), stand.at_m.y(), stand.at_m.z()}},
          {"turn_deg", stand.turn_rad * degrees},
          {"height_m", stand.height_m},
          {"stickout_m", stand.stickout_m},
          {"estimate", share_json(one.share)},
          {"is_blocked", one.reach.is_blocked},
          {"home_is_free", one.reach.home_is_free}};
}

}  // namespace

std::string place_table(const PlaceReport& report, int rows) {
  const Joint& moved = report.cell.robot.joints[static_cast<std::size_t>(report.joint)];
  std::string text = "Moved: joint '" + moved.name + "', which carries '" + link_name(report.cell, moved.child_link) +
                     "' in '" + link_name(report.cell, moved.parent_link) + "'. " +
                     std::to_string(report.rated.size()) +
                     " stands. Shares in % of what is to be removed: what can be reached, by estimate and certified, "
                     "and why the rest cannot.\n\n";
  text +=
      " rank      x m      y m      z m   turn d height m   tool m  reached certified    tool  stock  links limits  "
      "reach\n";
  for (std::size_t at = 0; at < report.rated.size(); ++at)
    if (at < static_cast<std::size_t>(rows) || report.rated[at].stand == report.own) text += row(report, at);
  const auto own = std::ranges::find(report.rated, report.own, &RatedStand::stand);
  if (own != report.rated.end() && own->share.held == report.rated.front().share.held)
    text += "\nNo stand reaches more than the cell's own.\n";
  return text + map_text(report) + turn_over_text(report);
}

std::string place_json(const PlaceReport& report) {
  const Joint& moved = report.cell.robot.joints[static_cast<std::size_t>(report.joint)];
  nlohmann::ordered_json document{{"cell", report.cell.name},
                                  {"moved",
                                   {{"joint", moved.name},
                                    {"parent", link_name(report.cell, moved.parent_link)},
                                    {"child", link_name(report.cell, moved.child_link)}}},
                                  {"stands", nlohmann::ordered_json::array()}};
  for (std::size_t at = 0; at < report.rated.size(); ++at) {
    nlohmann::ordered_json stand = stand_json(report.rated[at]);
    stand["is_own"] = report.rated[at].stand == report.own;
    if (at < report.certified.size()) {
      const CertifiedShare& share = report.certified[at];
      stand["certified"] = {{"removable", share.removable},
                            {"held", share.held},
                            {"tool", share.tool},
                            {"home_contact", share.home_contact}};
    }
    document["stands"].push_back(std::move(stand));
  }
  document["best"] = report.best;
  for (const TurnOver& turn : report.turn_overs)
    document["turn_overs"].push_back({{"rotate_deg", {turn.rotate_deg.x(), turn.rotate_deg.y(), turn.rotate_deg.z()}},
                                      {"estimate", share_json(turn.share)}});
  return document.dump(2);
}

}  // namespace sculpt::cli
