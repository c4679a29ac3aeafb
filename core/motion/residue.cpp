#include "core/motion/residue.hpp"

namespace sculpt {

const char* name(Reason reason) {
  switch (reason) {
    case Reason::enclosed:
      return "enclosed";
    case Reason::tool_cannot_reach:
      return "tool cannot reach";
    case Reason::out_of_reach:
      return "out of reach";
    case Reason::joint_limits:
      return "joint limits";
    case Reason::link_collision:
      return "link collision";
    case Reason::no_transit:
      return "no transit";
    case Reason::loose_piece:
      return "would free a loose piece";
    case Reason::behind_out_of_reach:
      return "behind voxels left for reach";
    case Reason::behind_joint_limits:
      return "behind voxels left for joint limits";
    case Reason::behind_link_collision:
      return "behind voxels left for link collision";
    case Reason::behind_no_transit:
      return "behind voxels left for no transit";
    case Reason::behind_loose_piece:
      return "behind voxels left for a loose piece";
  }
  return "unknown";
}

}  // namespace sculpt
