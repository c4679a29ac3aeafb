// What an examination of a cell finds: plain values, in the order in which they are told.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/collision/near_bodies.hpp"

namespace sculpt {

/// Of the chain from stock to tool; rad or m.
struct JointFinding {
  std::string name;
  JointKind kind = JointKind::revolute;
  double lower = 0, upper = 0, home = 0;
  bool carries_stock = false;          ///< it moves the stock, not the tool
  std::vector<std::string> followers;  ///< joints that mimic it
};

/// A joint that could move but stands still while the chain moves.
struct IdleJoint {
  std::string name, child_link;
  JointKind kind = JointKind::revolute;
  double at = 0;                  ///< rad or m
  bool rides_on_the_arm = false;  ///< a joint of the chain carries it about
};

struct BodyFinding {
  std::string link;
  std::size_t shapes = 0, facets = 0;  ///< facets of its meshes
  Vec3 size_m = Vec3::Zero();          ///< of a box around it, along the axes of the link's frame
  std::string moved_by = {};           ///< the joint nearest above it that can move; empty: it stands still in the room
};

/// Two links, or a link and the tool or the stock, by name.
struct PairFinding {
  std::string first, second;
  std::string why = {};  ///< why they are not kept apart; empty where they are
  double gap_m = 0;      ///< of two that are near: at least so much
};

struct HomeFinding {
  std::vector<double> q;  ///< in the order of the chain's joints
  Vec3 ball_m = Vec3::Zero(),
       axis = Vec3::UnitZ();           ///< in the frame of the stock's cube: (0, 0, 0) is its lowest corner
  std::vector<PairFinding> blocking;   ///< nearer than planning allows
  std::vector<NearBodies> bodies;      ///< the same, by number
  std::optional<PairFinding> nearest;  ///< of the others, within 20 mm
};

/// How far the tool comes along one direction, as places of a lattice in the stock.
struct DirectionFinding {
  std::string name;  ///< "+z" and so on: from the ball towards the spindle
  Vec3 axis = Vec3::UnitZ();
  int places = 0;
  int free = 0;           ///< a configuration within limits, clear of links, room and the full stock, was found
  int blocked = 0;        ///< one within limits was found, none that is clear
  int beyond_limits = 0;  ///< joints would have to leave their limits
  int out_of_reach = 0;
  std::vector<std::pair<PairFinding, int>> blockers;  ///< what was in the way where, most frequent first
  double field = 0;  ///< share of the stock for which the sweep planner has certified postures along it
};

/// Values of joints, by name; rad or m.
using JointValues = std::map<std::string, double>;

struct Fault {
  enum class Weight { note, warning, error };  ///< error: `plan` refuses the cell

  Weight weight = Weight::note;
  std::string code;      ///< a stable word, e.g. "home_blocked"
  std::string sentence;  ///< what is wrong
  std::string cure;      ///< what to do about it
};

struct CellFindings {
  std::string name, stock_link, tool_link;
  int resolution = 0;
  std::vector<JointFinding> chain;
  std::vector<IdleJoint> idle_joints;
  std::vector<BodyFinding> bodies;
  std::vector<PairFinding> checked_pairs, unchecked_pairs;
  std::vector<PairFinding> home_contacts;  ///< that a replay finds in contact at home
  std::vector<PairFinding> wide_pairs;  ///< of the checked ones, neighbours that leave their joint little room, and why
  double stock_size_m = 0, stickout_m = 0, free_length_m = 0, ball_radius_m = 0;
  HomeFinding home;
  std::vector<DirectionFinding> directions;
  double reached = 0;                      ///< share of the lattice's places that are free along some direction
  double scene_s = 0, fields_s = 0;        ///< wall time of what a plan does before it begins
  bool fields_kept = false;                ///< they were found by an earlier run
  std::optional<JointValues> better_home;  ///< a home that is free, where the cell's is none
  std::vector<Fault> faults;               ///< errors first

  bool plannable() const { return faults.empty() || faults.front().weight != Fault::Weight::error; }
};

}  // namespace sculpt
