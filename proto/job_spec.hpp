// What is to be planned, as it stands in job.submit.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/fields.hpp"
#include "proto/motion/motion_spec.hpp"

namespace sculpt::proto {

struct BlobRef {
  std::string sha256;
  std::string name;  ///< file name of the client; its extension says what the blob is
};

/// Metres and radians; meaning as in core/solid/placement.hpp.
struct PlacementSpec {
  std::optional<double> scale_m;
  std::array<double, 3> rotation_rad{};
  std::array<double, 3> offset_m{};
  double margin_m = 0;
};

struct BoxSpec {
  std::array<double, 3> min_m{}, max_m{};
};

/// The job that another one goes on with, and how its block is clamped for that.
struct ContinueSpec {
  std::string job;
  std::array<double, 3> rotation_rad{};
};

/// A clamping behind the first, as in core/plan/job.hpp.
struct ClampingSpec {
  std::string left;  ///< hash of the .binvox
  std::array<double, 3> rotation_rad{};
};

/// Milling tools, in the order that they are used in; meaning as in core/plan/job.hpp.
struct MillSpec {
  std::vector<std::string> tools;
  Json library;  ///< the tool library itself
  double tolerance_m = 1e-4;
  std::optional<double> scallop_m, allowance_m;
};

struct JobSpec {
  BlobRef mesh;
  std::string robot;        ///< name of a cell on the server; empty if `cell_bundle` is set
  std::string cell_bundle;  ///< hash of a cell bundle; empty if `robot` is set
  std::int64_t resolution = 0;
  std::optional<std::string> search;
  std::uint64_t seed = 0;
  std::optional<int> threads;
  bool allow_freed = false;
  std::optional<MillSpec> mill;
  std::optional<MotionSpec> motion;
  PlacementSpec placement;
  std::optional<BoxSpec> stock_box;
  std::optional<BlobRef> stock_mesh;
  std::optional<ContinueSpec> continued;  ///< then neither placement nor stock was given
  std::vector<ClampingSpec> clampings;    ///< no field of the wire: what the server finds out about `continued`
};

/// A cell on the server, or one that was sent: the other is empty.
struct CellRef {
  std::string name, bundle;
};
/// The field "robot".
CellRef read_robot(Fields& fields);

/// Throws ProtocolError `params_invalid` with the pointer of the field to blame.
JobSpec read_job_spec(Fields fields);

/// Fields at their default are left out, the rest stands in a fixed order: equal specs give equal text.
Json to_json(const JobSpec& spec);

}  // namespace sculpt::proto
