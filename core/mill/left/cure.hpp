// What kept milling tools from a part of what they left, and which tool would come to it.
#pragma once

#include <string>

namespace sculpt {

/// What kept the tools of a job from a place.
enum class Obstacle {
  way,     ///< one of them would come to it: the arm did not, or it was too little to be worth a pass
  length,  ///< one is thin enough, but what is above its cutter is in the way: it is too short
  radius,  ///< only a thinner cutter comes there
  side     ///< none, along none of the directions
};

/// "way", "length", "radius", "side".
const char* name(Obstacle obstacle);

/// A ball cutter that would come to a part of what was left.
struct Cure {
  Obstacle obstacle = Obstacle::side;
  double diameter_m = 0;  ///< of the cutter; 0 where none comes there
  double free_m = 0;      ///< from its tip to what is thicker than the cutter, in whole millimetres; 0 if no matter
  double share = 0;       ///< of what was left
  int resolution = 0;     ///< the least one whose voxels are small enough for the cutter's ways; 0: the job's are

  /// "D4 with 62 mm free would reach it".
  std::string sentence() const;
};

}  // namespace sculpt
