// What a replay found.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sculpt {

struct Finding {
  std::uint64_t line = 0;  ///< 1-based line of the trajectory
  std::string sentence;    ///< what touches what, where
};

/// Findings of one piece of a trajectory, or of several.
struct PieceFindings {
  std::uint64_t collisions = 0, voxels_checked = 0;
  std::vector<Finding> findings;  ///< the first 100

  void find(std::uint64_t line, std::string sentence);
  /// Those of the piece after.
  void add(PieceFindings&& next);
};

/// How far a replay is: this many pieces from the first on are done, and this was found.
struct ReplayedPieces {
  std::uint64_t pieces = 0;
  PieceFindings found;
};

}  // namespace sculpt
