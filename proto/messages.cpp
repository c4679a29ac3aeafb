#include "proto/messages.hpp"

#include "proto/framing.hpp"

namespace sculpt::proto {
namespace {

constexpr std::size_t max_job_id_bytes = 64;
constexpr std::size_t max_text_bytes = 200;
constexpr int max_priority = 100;
constexpr int max_list = 1000;
constexpr double max_wait_s = 86400;
constexpr int min_check_resolution = 8, max_check_resolution = 1024;
constexpr std::int64_t max_runtime_s = 366 * 86400;

Fields params_of(const Json& params) {
  return Fields(params, "/params");
}

std::string read_order(Fields& fields) {
  std::string order = fields.text("order", max_text_bytes);
  if (order != "oldest" && order != "newest") fields.refuse("order", "must be oldest or newest, not '" + order + "'");
  return order;
}

}  // namespace

HelloParams read_hello(const Json& params) {
  Fields fields = params_of(params);
  HelloParams hello;
  const Json& version = fields.value("protocol");
  const auto small = [](const Json& number) {
    return number.is_number_integer() && number.get<std::int64_t>() >= 0 && number.get<std::int64_t>() < 1000;
  };
  if (!version.is_array() || version.size() != 2 || !small(version[0]) || !small(version[1])) {
    fields.refuse("protocol", "must be [major, minor], for example [1,0]");
  }
  hello.major = version[0].get<int>();
  hello.minor = version[1].get<int>();
  hello.client = fields.text("client", max_text_bytes);
  if (fields.has("token")) hello.token = fields.text("token", max_text_bytes);
  hello.max_line = max_line_bytes;
  if (fields.has("max_line")) {
    hello.max_line = static_cast<std::size_t>(fields.integer("max_line", min_max_line, max_line_bytes));
  }
  fields.done();
  return hello;
}

BlobPutParams read_blob_put(const Json& params) {
  Fields fields = params_of(params);
  BlobPutParams put{fields.sha256("sha256"), fields.count("size"), fields.count("offset"),
                    fields.count("bytes", max_chunk_bytes)};
  fields.done();
  if (put.offset > put.size || put.bytes > put.size - put.offset) {
    fields.refuse("bytes", "reaches beyond size: offset " + std::to_string(put.offset) + " + bytes " +
                               std::to_string(put.bytes) + " > size " + std::to_string(put.size));
  }
  return put;
}

std::string read_blob_name(const Json& params) {
  Fields fields = params_of(params);
  std::string hash = fields.sha256("sha256");
  fields.done();
  return hash;
}

CellCheckParams read_cell_check(const Json& params) {
  Fields fields = params_of(params);
  CellCheckParams check;
  check.robot = read_robot(fields);
  if (fields.has("resolution"))
    check.resolution = static_cast<int>(fields.integer("resolution", min_check_resolution, max_check_resolution));
  fields.done();
  return check;
}

SubmitParams read_submit(const Json& params) {
  Fields fields = params_of(params);
  SubmitParams submit;
  if (fields.has("key")) submit.key = fields.text("key", max_text_bytes);
  if (fields.has("priority"))
    submit.priority = static_cast<int>(fields.integer("priority", -max_priority, max_priority));
  if (fields.has("queue")) submit.queue = fields.text("queue", max_text_bytes);
  if (fields.has("not_before")) submit.not_before = fields.utc_time("not_before");
  if (fields.has("start_by")) submit.start_by = fields.utc_time("start_by");
  if (!submit.start_by.empty() && submit.start_by <= submit.not_before) {
    fields.refuse("start_by", "must be after not_before, else the job can never start");
  }
  if (fields.has("max_runtime_s")) submit.max_runtime_s = fields.integer("max_runtime_s", 1, max_runtime_s);
  submit.spec = read_job_spec(fields.object("spec"));
  fields.done();
  return submit;
}

namespace {

constexpr double min_rate_hz = 0.001, max_rate_hz = 1e6, max_motion_s = 1e9;
constexpr std::size_t max_holds = 1000;

std::vector<double> read_holds(Fields& fields) {
  const Json& times = fields.value("holds_s");
  if (!times.is_array() || times.size() > max_holds)
    fields.refuse("holds_s", "must be a list of at most " + std::to_string(max_holds) + " times, in seconds");
  std::vector<double> holds;
  for (const Json& time : times) {
    if (!time.is_number() || time.get<double>() < 0 || time.get<double>() > max_motion_s ||
        (!holds.empty() && time.get<double>() < holds.back()))
      fields.refuse("holds_s", "must be times of the motion, in seconds, in their order");
    holds.push_back(time.get<double>());
  }
  return holds;
}

}  // namespace

std::string read_job_id(const Json& params) {
  Fields fields = params_of(params);
  std::string job = fields.text("job", max_job_id_bytes);
  fields.done();
  return job;
}

ListParams read_list(const Json& params) {
  Fields fields = params_of(params);
  ListParams list;
  if (fields.has("after")) list.after = fields.text("after", max_job_id_bytes);
  if (fields.has("before")) list.before = fields.text("before", max_job_id_bytes);
  if (fields.has("order")) list.newest = read_order(fields) == "newest";
  if (fields.has("limit")) list.limit = static_cast<int>(fields.integer("limit", 1, max_list));
  fields.done();
  return list;
}

WaitParams read_wait(const Json& params) {
  Fields fields = params_of(params);
  WaitParams wait{fields.text("job", max_job_id_bytes), fields.number("timeout_s", 0, max_wait_s)};
  fields.done();
  return wait;
}

SubscribeParams read_subscribe(const Json& params) {
  Fields fields = params_of(params);
  SubscribeParams subscribe;
  if (fields.has("job")) subscribe.job = fields.text("job", max_job_id_bytes);
  if (fields.has("after")) subscribe.after = fields.count("after");
  fields.done();
  return subscribe;
}

std::string read_unsubscribe(const Json& params) {
  Fields fields = params_of(params);
  std::string job = fields.has("job") ? fields.text("job", max_job_id_bytes) : std::string();
  fields.done();
  return job;
}

namespace {

std::optional<ProgramSpec> read_wanted_program(Fields& fields, const std::string& artifact) {
  if (artifact == "program") return read_program(fields.object("program"));
  if (fields.has("program")) fields.refuse("program", "must be left out: it says which program is wanted");
  return {};
}

}  // namespace

ArtifactReadParams read_artifact_read(const Json& params) {
  Fields fields = params_of(params);
  ArtifactReadParams read{fields.text("job", max_job_id_bytes), fields.text("artifact", max_text_bytes), {}, 0, 0};
  if (fields.has("format")) read.format = fields.text("format", max_text_bytes);
  read.offset = fields.count("offset");
  read.bytes = static_cast<std::size_t>(fields.integer("bytes", 1, max_chunk_bytes));
  read.program = read_wanted_program(fields, read.artifact);
  fields.done();
  return read;
}

ArtifactReadParams read_artifact_link(const Json& params) {
  Fields fields = params_of(params);
  ArtifactReadParams wanted{fields.text("job", max_job_id_bytes), fields.text("artifact", max_text_bytes), {}, 0, 0};
  if (fields.has("format")) wanted.format = fields.text("format", max_text_bytes);
  wanted.program = read_wanted_program(fields, wanted.artifact);
  fields.done();
  return wanted;
}

CellReadParams read_cell_read(const Json& params) {
  Fields fields = params_of(params);
  CellReadParams read{fields.text("job", max_job_id_bytes), {}, fields.count("offset"), 0};
  if (fields.has("file")) read.file = fields.sha256("file");
  read.bytes = static_cast<std::size_t>(fields.integer("bytes", 1, max_chunk_bytes));
  fields.done();
  return read;
}

SamplesParams read_samples(const Json& params) {
  Fields fields = params_of(params);
  SamplesParams samples;
  samples.job = fields.text("job", max_job_id_bytes);
  if (fields.has("motion")) samples.motion = read_motion(fields.object("motion"));
  samples.rate_hz = fields.number("rate_hz", min_rate_hz, max_rate_hz);
  if (fields.has("from_s")) samples.from_s = fields.number("from_s", 0, max_motion_s);
  if (fields.has("to_s")) samples.to_s = fields.number("to_s", 0, max_motion_s);
  if (fields.has("count")) samples.count = fields.count("count");
  if (samples.count == 0) fields.refuse("count", "must be 1 or more");
  if (fields.has("holds_s")) samples.holds_s = read_holds(fields);
  fields.done();
  return samples;
}

PinParams read_pin(const Json& params) {
  Fields fields = params_of(params);
  PinParams pin{fields.text("job", max_job_id_bytes), true};
  if (fields.has("pinned")) pin.pinned = fields.flag("pinned");
  fields.done();
  return pin;
}

SchemaParams read_schema(const Json& params) {
  Fields fields = params_of(params);
  SchemaParams wanted;
  if (fields.has("method")) wanted.method = fields.text("method", max_text_bytes);
  if (fields.has("part")) wanted.part = fields.text("part", max_text_bytes);
  if (!wanted.method.empty() && !wanted.part.empty()) fields.refuse("part", "must be left out beside method");
  fields.done();
  return wanted;
}

void read_nothing(const Json& params) {
  params_of(params).done();
}

Json to_json(const EventMessage& event) {
  Json json = Json::object();
  if (!event.job.empty()) json["job"] = event.job;
  if (event.seq) json["seq"] = *event.seq;
  if (event.number) json["number"] = *event.number;
  if (!event.time.empty()) json["t"] = event.time;
  json["type"] = event.type;
  if (!event.data.is_null()) json["data"] = event.data;
  return json;
}

}  // namespace sculpt::proto
