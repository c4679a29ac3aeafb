// Trajectory file -> the points that its motion goes through, in little memory.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <vector>

#include "core/law/law_file.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Home is point 0. Keyframes that are where the one before them is are left out.
class PlanPath {
 public:
  /// What happens on the edge that leads to a point.
  struct Edge {
    std::uint32_t keyframe = 0;  ///< number of the point's keyframe in the file, from 1
    std::array<std::int16_t, 3> last{};
    std::uint16_t voxels = 0;   ///< that a thin tool cuts
    std::uint32_t removed = 0;  ///< that any tool does, and keyframes do that are left out behind it
    std::uint8_t way = 0;       ///< 1 to 6: along which of the grid's axes these lie; 0: neither is known
    std::uint8_t tool = 0;      ///< of the header's milling tools, the one in the spindle
    bool cut = false;
    bool placed = false;  ///< a milling tool's tip goes straight, in one direction
    bool rest = false;    ///< the motion must come to rest at the point: a tool is changed there
  };

  /// A keyframe of a plan with milling tools, those that are left out too.
  struct Milled {
    MillStep step;
    std::size_t point = 0;  ///< where it ends
    bool cut = false;
  };

  /// Reads the file to its end. Throws InputError `trajectory_invalid`.
  explicit PlanPath(std::istream& in);

  const TrajectoryHeader& header() const { return header_; }
  std::size_t dof() const { return dof_; }
  /// Points, home included: at least 1.
  std::size_t size() const { return edges_.size(); }
  std::uint64_t keyframes() const { return keyframes_; }
  /// dof() values.
  const double* point(std::size_t at) const { return chunks_[at / chunk].get() + at % chunk * dof_; }
  Configuration configuration(std::size_t at) const {
    return Eigen::Map<const Configuration>(point(at), static_cast<Eigen::Index>(dof_));
  }
  const Edge& edge_to(std::size_t at) const { return edges_[at]; }
  /// None of a plan with a thin tool.
  const std::vector<Milled>& milled() const { return milled_; }
  /// Those that are cut on the edge to this point, the m-th of them.
  Voxel voxel_of(std::size_t at, int m) const;

 private:
  static constexpr std::size_t chunk = 4096;
  void add(const Configuration& q, const Edge& edge);

  TrajectoryHeader header_;
  std::size_t dof_ = 0;
  std::uint64_t keyframes_ = 0;
  std::vector<std::unique_ptr<double[]>> chunks_;
  std::vector<Edge> edges_;
  std::vector<Milled> milled_;
};

/// Of all keyframes, those that are left out too.
PlanMark mark_of(const PlanPath& path);

}  // namespace sculpt
