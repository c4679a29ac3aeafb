#include "core/doctor/find_faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "core/collision/link_pairs.hpp"
#include "core/doctor/describe_cell.hpp"
#include "core/doctor/metres.hpp"

namespace sculpt {
namespace {

using Weight = Fault::Weight;

constexpr double max_body_m = 20, min_body_m = 2e-4;
constexpr std::size_t many_facets = 200'000, told_pairs = 2;
constexpr double min_reach = 0.999, little_reach = 0.5;

std::string quoted(const std::string& name) {
  return "'" + name + "'";
}

std::string in_mm(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1000 * metres);
  return text;
}

std::string in_percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, share > 0.99 && share < 1 ? "%.1f %%" : "%.0f %%", 100 * share);
  return text;
}

/// Of what is in the way at home, what a joint moves that nothing drives.
std::string idle_in_the_way(const CellFindings& found) {
  for (const PairFinding& pair : found.home.blocking)
    for (const IdleJoint& idle : found.idle_joints)
      for (const BodyFinding& body : found.bodies)
        if (body.moved_by == idle.name && (body.link == pair.first || body.link == pair.second))
          return "; nothing drives joint " + quoted(idle.name) + " that moves " + quoted(body.link) +
                 ": give it a <mimic> of the joint that it goes along with, or take it out of the URDF";
  return {};
}

std::string another_home(const CellFindings& found) {
  if (found.better_home) return "take the home that is free, below (\"better_home\")";
  return "no free home was found with the ball above the stock: make room there (move the table, raise the arm, "
         "lengthen "
         "the tool), or list pairs of links that may touch in \"ignore_pairs\"";
}

void check_sizes(const BodyFinding& body, std::vector<Fault>& faults) {
  if (body.size_m.maxCoeff() > max_body_m)
    faults.push_back(
        {Weight::warning, "body_size",
         quoted(body.link) + " is " + in_metres(body.size_m.maxCoeff()) + " long: its mesh seems to be in mm",
         "give its <mesh> scale=\"0.001 0.001 0.001\" in the URDF"});
  if (body.size_m.maxCoeff() < min_body_m)
    faults.push_back({Weight::warning, "body_size",
                      quoted(body.link) + " is no more than " + in_mm(body.size_m.maxCoeff()) + " long",
                      "look at the scale of its <mesh> in the URDF: lengths are metres"});
  if (body.facets > many_facets)
    faults.push_back({Weight::note, "many_facets",
                      quoted(body.link) + " has " + std::to_string(body.facets) + " facets, which makes checks slow",
                      "reduce its collision mesh to some thousand facets"});
}

/// Links between two moving joints of the chain that nothing is known of the shape of: nobody keeps clear of them.
void check_bare_links(const Cell& cell, std::vector<Fault>& faults) {
  const Chain chain = cell.chain();
  if (chain.translating()) return;
  const std::vector<int> group = rigid_groups(cell.robot);
  for (const int index : chain.joints()) {
    const Joint& joint = cell.robot.joints[static_cast<std::size_t>(index)];
    const int moved = group[static_cast<std::size_t>(joint.child_link)];
    bool has_shape = false;
    for (std::size_t link = 0; link < group.size(); ++link)
      has_shape = has_shape || (group[link] == moved && !cell.robot.links[link].shapes.empty());
    if (!has_shape)
      faults.push_back({Weight::warning, "no_shape",
                        "what joint " + quoted(joint.name) + " moves (" +
                            quoted(cell.robot.links[static_cast<std::size_t>(joint.child_link)].name) +
                            ") has no <collision> shape: nothing keeps it out of the way",
                        "give it one in the URDF, unless it has no body"});
  }
}

void check_idle_joints(const CellFindings& found, std::vector<Fault>& faults) {
  for (const IdleJoint& idle : found.idle_joints)
    if (idle.rides_on_the_arm)
      faults.push_back({Weight::note, "idle_joint",
                        "joint " + quoted(idle.name) + " (it moves " + quoted(idle.child_link) +
                            ") is carried about by the arm, but lies beside the chain: it is kept where home has it",
                        "if another joint drives it, as in a parallel bar or a cylinder beside the arm, give it a "
                        "<mimic> in the URDF; if nothing does, make it fixed; if it is a gripper, take it out"});
}

void check_tool(const Cell& cell, const CellFindings& found, std::vector<Fault>& faults) {
  if (const std::string link = find_link_in_tool(cell); !link.empty())
    faults.push_back({Weight::warning, "tool_in_link",
                      "the tool goes through " + quoted(link) + ", which carries it: it points into the arm",
                      "turn the frame of " + quoted(found.tool_link) + " so that its +z points out of the spindle"});
  if (cell.chain().translating() || cell.tool.stickout_m == 0) return;
  if (found.free_length_m >= found.stock_size_m) return;
  faults.push_back({Weight::note, "short_tool",
                    "the tool's free length of " + in_mm(found.free_length_m) + " is less than the stock's edge of " +
                        in_mm(found.stock_size_m) + ": deep, narrow places will be left",
                    "raise \"stickout_m\" by " + in_mm(1.05 * found.stock_size_m - found.free_length_m) +
                        ", if a tool of that length can be bought"});
}

std::string blocking_text(const HomeFinding& home) {
  std::string text;
  for (std::size_t at = 0; at < std::min(told_pairs, home.blocking.size()); ++at) {
    const PairFinding& pair = home.blocking[at];
    text += (at == 0 ? "" : ", ") + pair.first + " and " + pair.second +
            (pair.gap_m > 0 ? " are only " + in_mm(pair.gap_m) + " apart" : std::string(" touch"));
  }
  if (home.blocking.size() > told_pairs) text += ", and " + std::to_string(home.blocking.size() - told_pairs) + " more";
  return text;
}

bool names_pair(const std::vector<PairFinding>& pairs, const PairFinding& sought) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const PairFinding& pair) {
    return std::minmax(pair.first, pair.second) == std::minmax(sought.first, sought.second);
  });
}

bool is_below_top(const CellFindings& found) {
  const Vec3& ball = found.home.ball_m;
  return ball.z() < found.stock_size_m;
}

bool is_in_the_cube(const CellFindings& found) {
  const Vec3& ball = found.home.ball_m;
  return ball.minCoeff() >= 0 && ball.maxCoeff() <= found.stock_size_m;
}

/// The two that block a direction most.
std::string blockers_text(const DirectionFinding& direction) {
  std::string text;
  for (std::size_t at = 0; at < std::min<std::size_t>(2, direction.blockers.size()); ++at) {
    const auto& [pair, places] = direction.blockers[at];
    text += (at > 0 ? ", " : "") + pair.first + " and " + pair.second + " at " + std::to_string(places);
  }
  return text;
}

/// What stops the arm at most of the places that are not free, all directions together.
struct Causes {
  int places = 0, free = 0, blocked = 0, beyond_limits = 0, out_of_reach = 0;
  int by_stock = 0, by_itself = 0, by_room = 0;  ///< of `blocked`
};

Causes add_up(const CellFindings& found, const std::vector<DirectionFinding>& directions) {
  const auto rides_on_the_arm = [&](const std::string& name) {
    return name == "the tool" || std::any_of(found.bodies.begin(), found.bodies.end(), [&](const BodyFinding& body) {
             return body.link == name && std::any_of(found.chain.begin(), found.chain.end(), [&](const auto& joint) {
                      return joint.name == body.moved_by && !joint.carries_stock;
                    });
           });
  };
  Causes sum;
  for (const DirectionFinding& direction : directions) {
    sum.places += direction.places;
    sum.free += direction.free;
    sum.blocked += direction.blocked;
    sum.beyond_limits += direction.beyond_limits;
    sum.out_of_reach += direction.out_of_reach;
    for (const auto& [pair, places] : direction.blockers)
      (pair.second == "the stock"                                      ? sum.by_stock
       : rides_on_the_arm(pair.first) && rides_on_the_arm(pair.second) ? sum.by_itself
                                                                       : sum.by_room) += places;
  }
  return sum;
}

std::string cure_of(const Causes& causes) {
  const int worst = std::max({causes.blocked, causes.beyond_limits, causes.out_of_reach});
  if (worst == causes.out_of_reach) return "bring stock and arm nearer to each other, or make the stock smaller";
  if (worst == causes.beyond_limits) return "place the stock where the joints are nearer to the middle of their limits";
  if (causes.by_itself > std::max(causes.by_stock, causes.by_room))
    return "place the stock where the arm need not fold up to come there: it is in its own way";
  if (causes.by_stock > causes.by_room)
    return "lengthen the tool (\"stickout_m\"), so that what carries it stays out of the stock's cube";
  return "raise the table or make it slimmer, so that a level tool has room beside it";
}

}  // namespace

void find_faults_of_files(const CellDraft& draft, CellFindings& found) {
  for (const BodyFinding& body : found.bodies) check_sizes(body, found.faults);
  check_bare_links(draft.cell, found.faults);
  check_idle_joints(found, found.faults);
  check_tool(draft.cell, found, found.faults);
  for (const PairFinding& pair : found.wide_pairs)
    found.faults.push_back({Weight::warning, "wide_contact",
                            quoted(pair.first) + " and " + quoted(pair.second) + " " + pair.why +
                                " and are kept apart: little of it is left to plan with",
                            "if their shapes are thicker than the arm, which does not touch itself there, add [\"" +
                                pair.first + "\", \"" + pair.second + "\"] to \"ignore_pairs\""});
  for (const PairFinding& pair : found.unchecked_pairs)
    if (pair.why == "touch at home and in every configuration tried" && !names_pair(found.home_contacts, pair))
      found.faults.push_back(
          {Weight::note, "unproved_pair",
           quoted(pair.first) + " and " + quoted(pair.second) + " touch wherever it was tried, and are not kept apart",
           "if that surprises you, list them in \"check_pairs\""});
}

bool home_is_poor(const CellDraft& draft, const CellFindings& found) {
  return !draft.home_faults.empty() || !found.home.blocking.empty() || is_below_top(found);
}

void find_faults_of_home(const CellDraft& draft, CellFindings& found) {
  for (const InputError& error : draft.home_faults)
    found.faults.push_back({Weight::error, "home_invalid", error.what(), another_home(found)});
  if (!found.home.blocking.empty())
    found.faults.push_back({Weight::error, "home_blocked", "at home " + blocking_text(found.home),
                            another_home(found) + idle_in_the_way(found)});
  for (const PairFinding& pair : found.home_contacts) {
    if (names_pair(found.home.blocking, pair)) continue;
    found.faults.push_back({Weight::error, "home_contact",
                            quoted(pair.first) + " and " + quoted(pair.second) +
                                " touch at home, and not where a joint holds them together: the replay would find them",
                            "if their shapes are thicker than the arm, which does not touch itself there, add [\"" +
                                pair.first + "\", \"" + pair.second +
                                "\"] to \"ignore_pairs\"; if they can really touch, make them smaller or move them"});
  }
  if (!found.home.blocking.empty() || !is_below_top(found)) return;
  const bool inside = is_in_the_cube(found);
  found.faults.push_back({Weight::warning, "home_low",
                          std::string("at home the ball is ") +
                              (inside ? "inside the stock's cube" : "below the top of the stock") + ", at " +
                              in_metres(found.home.ball_m.z()) + " above its bottom",
                          another_home(found)});
}

bool reach_is_poor(const CellFindings& found) {
  return found.reached < min_reach ||
         std::any_of(found.directions.begin(), found.directions.end(),
                     [](const DirectionFinding& d) { return d.free < little_reach * d.places; });
}

void find_faults_of_reach(const Chain& chain, CellFindings& found) {
  const Causes causes = add_up(found, found.directions);
  if (causes.free == 0) {
    found.faults.push_back({Weight::error, "nothing_reached",
                            "the arm can hold the tool at no place of the stock that was tried (" +
                                std::to_string(causes.places) + " places and directions)",
                            cure_of(causes)});
  } else if (found.reached < min_reach) {
    found.faults.push_back({Weight::warning, "part_unreached",
                            "of the places in the stock that were tried the arm reaches " + in_percent(found.reached) +
                                " along a straight direction: about the rest of the voxels will be left",
                            cure_of(causes)});
  }
  if (chain.translating() || causes.free == 0) return;
  for (const DirectionFinding& direction : found.directions)
    if (direction.free < little_reach * direction.places)
      found.faults.push_back({Weight::note, "direction_unused",
                              "along " + direction.name + " the arm reaches " +
                                  in_percent(static_cast<double>(direction.free) / direction.places) +
                                  " of the stock (" + std::to_string(direction.out_of_reach) + " places too far, " +
                                  std::to_string(direction.beyond_limits) + " beyond joint limits, " +
                                  std::to_string(direction.blocked) + " blocked" +
                                  (direction.blockers.empty() ? "" : ": " + blockers_text(direction)) + ")",
                              cure_of(add_up(found, {direction}))});
}

}  // namespace sculpt
