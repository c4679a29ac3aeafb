// The params of each method and the larger results, as plain structs. Reading throws ProtocolError `params_invalid`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "proto/job_spec.hpp"
#include "proto/motion/program_spec.hpp"

namespace sculpt::proto {

inline constexpr int protocol_major = 1;
inline constexpr int protocol_minor = 0;
inline constexpr std::size_t min_max_line = 256;

struct HelloParams {
  int major = 0, minor = 0;
  std::string client;
  std::string token;  ///< empty: none
  std::size_t max_line = 0;
};
HelloParams read_hello(const Json& params);

struct BlobPutParams {
  std::string sha256;
  std::uint64_t size = 0, offset = 0, bytes = 0;
};
BlobPutParams read_blob_put(const Json& params);
/// blob.has
std::string read_blob_name(const Json& params);

struct SubmitParams {
  std::string key;  ///< empty: none
  int priority = 0;
  std::string queue;  ///< empty: the one that all daemons serve unless told otherwise
  // Moments in UTC with milliseconds, empty: none.
  std::string not_before, start_by;
  std::int64_t max_runtime_s = 0;  ///< of one run; 0: no limit
  JobSpec spec;
};
SubmitParams read_submit(const Json& params);

struct CellCheckParams {
  CellRef robot;
  int resolution = 64;
};
CellCheckParams read_cell_check(const Json& params);

/// job.get, job.cancel, job.pause, job.resume, job.retry, job.report, job.verify, artifact.list
std::string read_job_id(const Json& params);

struct ListParams {
  std::string after = {}, before = {};  ///< only jobs between these two; empty: no bound
  bool newest = false;                  ///< the newest first
  int limit = 100;
};
ListParams read_list(const Json& params);

struct WaitParams {
  std::string job;
  double timeout_s = 0;
};
WaitParams read_wait(const Json& params);

struct SubscribeParams {
  std::string job;  ///< empty: all jobs
  std::uint64_t after = 0;
};
SubscribeParams read_subscribe(const Json& params);
/// The job, or empty for all.
std::string read_unsubscribe(const Json& params);

struct ArtifactReadParams {
  std::string job, artifact;
  std::string format;  ///< empty: the artifact's own
  std::uint64_t offset = 0;
  std::size_t bytes = 0;
  std::optional<ProgramSpec> program = {};  ///< of the artifact `program`, and of no other
};
ArtifactReadParams read_artifact_read(const Json& params);

/// artifact.link: the whole of a file.
ArtifactReadParams read_artifact_link(const Json& params);

/// job.cell: a piece of a job's cell bundle, or of one of the files that it names.
struct CellReadParams {
  std::string job;
  std::string file;  ///< hash; empty: the bundle itself
  std::uint64_t offset = 0;
  std::size_t bytes = 0;
};
CellReadParams read_cell_read(const Json& params);

/// job.samples: a window of a job's motion at a fixed rate. Times are seconds of the motion.
struct SamplesParams {
  std::string job;
  MotionSpec motion;
  double rate_hz = 0, from_s = 0;
  std::optional<double> to_s;        ///< without it to the end
  std::uint64_t count = UINT64_MAX;  ///< samples at most
  std::vector<double> holds_s;       ///< when the motion begins to come to rest on its path, and then goes on
};
SamplesParams read_samples(const Json& params);

struct PinParams {
  std::string job;
  bool pinned = true;
};
PinParams read_pin(const Json& params);

/// server.schema: what of the document is wanted; both empty: the whole.
struct SchemaParams {
  std::string method;
  std::string part;  ///< one that methods' answers leave out; not with a method
};
SchemaParams read_schema(const Json& params);

/// A method without params.
void read_nothing(const Json& params);

/// One event (section events.subscribe). Without seq: progress, live; with a number: of a subscription to all jobs.
struct EventMessage {
  std::string job;  ///< empty: all jobs
  std::optional<std::uint64_t> seq;
  std::string time;
  std::string type;
  Json data;
  std::optional<std::uint64_t> number = {};
};
Json to_json(const EventMessage& event);

}  // namespace sculpt::proto
