#include "proto/job_spec.hpp"

#include <limits>

namespace sculpt::proto {
namespace {

constexpr double huge = 1e6;  // metres or radians: beyond this a value is surely a mistake
constexpr int max_threads = 256;
constexpr std::size_t max_job_bytes = 64;

BlobRef read_blob_ref(Fields fields) {
  BlobRef ref{fields.sha256("blob"), fields.text("name", max_name_bytes)};
  fields.done();
  return ref;
}

Json to_json(const BlobRef& ref) {
  return {{"blob", ref.sha256}, {"name", ref.name}};
}

// A name, not a path: it is looked up among the server's own files.
std::string read_cell_name(Fields& fields) {
  std::string name = fields.text("robot", max_name_bytes);
  if (name.find_first_of("/\\") != std::string::npos || name.front() == '.' || name.ends_with(".json")) {
    fields.refuse(
        "robot",
        "must be the plain name of a cell on the server (see server.info); send a cell of your own as a bundle");
  }
  return name;
}

std::string read_cell_ref(Fields robot) {
  Fields cell = robot.object("cell");
  std::string hash = cell.sha256("blob");
  cell.done();
  robot.done();
  return hash;
}

PlacementSpec read_placement(Fields fields) {
  PlacementSpec placement;
  if (fields.has("scale_m")) placement.scale_m = fields.number("scale_m", std::numeric_limits<double>::min(), huge);
  if (fields.has("rotation_rad")) placement.rotation_rad = fields.triple("rotation_rad");
  if (fields.has("offset_m")) placement.offset_m = fields.triple("offset_m");
  if (fields.has("margin_m")) placement.margin_m = fields.number("margin_m", 0, huge);
  fields.done();
  return placement;
}

Json to_json(const PlacementSpec& placement) {
  const PlacementSpec plain;
  Json json = Json::object();
  if (placement.scale_m) json["scale_m"] = *placement.scale_m;
  if (placement.rotation_rad != plain.rotation_rad) json["rotation_rad"] = placement.rotation_rad;
  if (placement.offset_m != plain.offset_m) json["offset_m"] = placement.offset_m;
  if (placement.margin_m != plain.margin_m) json["margin_m"] = placement.margin_m;
  return json;
}

BoxSpec read_box(Fields fields) {
  BoxSpec box{fields.triple("min_m"), fields.triple("max_m")};
  fields.done();
  return box;
}

void read_stock(Fields fields, JobSpec& spec) {
  if (fields.has("box")) spec.stock_box = read_box(fields.object("box"));
  if (fields.has("mesh")) spec.stock_mesh = read_blob_ref(fields.object("mesh"));
  fields.done();
  if (spec.stock_box.has_value() == spec.stock_mesh.has_value()) {
    fields.refuse("box", "or mesh must be there, and not both");
  }
}

ContinueSpec read_continue(Fields fields) {
  ContinueSpec spec{fields.text("job", max_job_bytes), {}};
  if (fields.has("rotation_rad")) spec.rotation_rad = fields.triple("rotation_rad");
  fields.done();
  return spec;
}

Json to_json(const ContinueSpec& spec) {
  Json json{{"job", spec.job}};
  if (spec.rotation_rad != ContinueSpec{}.rotation_rad) json["rotation_rad"] = spec.rotation_rad;
  return json;
}

constexpr std::size_t max_tools = 16, max_library_bytes = 1 << 16;

MillSpec read_mill(Fields fields) {
  MillSpec spec;
  const Json& tools = fields.value("tools");
  if (!tools.is_array() || tools.empty() || tools.size() > max_tools)
    fields.refuse("tools", "must be a list of 1 to 16 names of tools");
  for (const Json& tool : tools) {
    if (!tool.is_string() || tool.get_ref<const std::string&>().empty() ||
        tool.get_ref<const std::string&>().size() > max_name_bytes)
      fields.refuse("tools", "must be a list of names");
    spec.tools.push_back(tool.get<std::string>());
  }
  spec.library = fields.value("library");
  if (!spec.library.is_object() || write_json(spec.library).size() > max_library_bytes)
    fields.refuse("library", "must be a tool library, as its file has it, of at most 64 KiB");
  if (fields.has("tolerance_m")) spec.tolerance_m = fields.number("tolerance_m", -huge, huge);
  if (fields.has("scallop_m")) spec.scallop_m = fields.number("scallop_m", -huge, huge);
  if (fields.has("allowance_m")) spec.allowance_m = fields.number("allowance_m", -huge, huge);
  fields.done();
  return spec;
}

Json to_json(const MillSpec& spec) {
  Json json{{"tools", spec.tools}, {"library", spec.library}};
  if (spec.tolerance_m != MillSpec{}.tolerance_m) json["tolerance_m"] = spec.tolerance_m;
  if (spec.scallop_m) json["scallop_m"] = *spec.scallop_m;
  if (spec.allowance_m) json["allowance_m"] = *spec.allowance_m;
  return json;
}

// The other job has said where the target is and what is around it.
void refuse_beside_continue(Fields& fields) {
  for (const char* field : {"placement", "stock"})
    if (fields.has(field))
      fields.refuse(field,
                    "must be left out beside continue: the mesh stands as in the job that is continued, in "
                    "what that one leaves");
}

}  // namespace

CellRef read_robot(Fields& fields) {
  if (fields.value("robot").is_object()) return {{}, read_cell_ref(fields.object("robot"))};
  return {read_cell_name(fields), {}};
}

JobSpec read_job_spec(Fields fields) {
  JobSpec spec;
  spec.mesh = read_blob_ref(fields.object("mesh"));
  CellRef cell = read_robot(fields);
  spec.robot = std::move(cell.name);
  spec.cell_bundle = std::move(cell.bundle);
  // Whether the number makes sense is the planner's to say (`resolution_invalid`).
  spec.resolution = fields.integer("resolution", std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  if (fields.has("search")) spec.search = fields.text("search", max_name_bytes);
  if (fields.has("seed")) spec.seed = fields.count("seed");
  if (fields.has("threads")) spec.threads = static_cast<int>(fields.integer("threads", 1, max_threads));
  if (fields.has("allow_freed")) spec.allow_freed = fields.flag("allow_freed");
  if (fields.has("mill")) spec.mill = read_mill(fields.object("mill"));
  if (fields.has("motion")) spec.motion = read_motion(fields.object("motion"));
  if (fields.has("placement")) spec.placement = read_placement(fields.object("placement"));
  if (fields.has("stock")) read_stock(fields.object("stock"), spec);
  if (fields.has("continue")) {
    spec.continued = read_continue(fields.object("continue"));
    refuse_beside_continue(fields);
  }
  fields.done();
  return spec;
}

Json to_json(const JobSpec& spec) {
  Json json;
  json["mesh"] = to_json(spec.mesh);
  json["robot"] = spec.cell_bundle.empty() ? Json(spec.robot) : Json{{"cell", {{"blob", spec.cell_bundle}}}};
  json["resolution"] = spec.resolution;
  if (spec.search) json["search"] = *spec.search;
  if (spec.seed != 0) json["seed"] = spec.seed;
  if (spec.threads) json["threads"] = *spec.threads;
  if (spec.allow_freed) json["allow_freed"] = true;
  if (spec.mill) json["mill"] = to_json(*spec.mill);
  if (spec.motion) json["motion"] = to_json(*spec.motion);
  if (Json placement = to_json(spec.placement); !placement.empty()) json["placement"] = std::move(placement);
  if (spec.stock_box) {
    json["stock"] = Json{{"box", {{"min_m", spec.stock_box->min_m}, {"max_m", spec.stock_box->max_m}}}};
  }
  if (spec.stock_mesh) json["stock"] = Json{{"mesh", to_json(*spec.stock_mesh)}};
  if (spec.continued) json["continue"] = to_json(*spec.continued);
  return json;
}

}  // namespace sculpt::proto
