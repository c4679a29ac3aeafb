#include "server/run/translate.hpp"

#include "core/base/extension.hpp"

namespace sculpt::server {
namespace {

Vec3 to_vector(const std::array<double, 3>& values) {
  return {values[0], values[1], values[2]};
}

const std::string cell_pointer = "/params/spec/robot/cell/blob", mesh_pointer = "/params/spec/mesh",
                  stock_pointer = "/params/spec/stock/mesh", continue_pointer = "/params/spec/continue/job";

std::string require_kind(const proto::BlobRef& ref, const std::string& pointer) {
  std::string kind = mesh_kind(ref.name);
  if (kind.empty()) {
    throw proto::ProtocolError(
        "params_invalid",
        "the mesh name '" + ref.name + "' has no extension, so its kind is unknown: name it as the file is named",
        pointer + "/name");
  }
  return kind;
}

MeshFile read_mesh(const proto::BlobRef& ref, const Blobs& blobs, const std::string& pointer) {
  std::string kind = require_kind(ref, pointer);
  return {blobs.read(ref.sha256, pointer + "/blob"), std::move(kind), ref.name};
}

JobSizes::File measure(const proto::BlobRef& ref, const Blobs& blobs, const std::string& pointer) {
  std::string kind = require_kind(ref, pointer);
  return {blobs.size(ref.sha256, pointer + "/blob"), std::move(kind)};
}

proto::CellBundle read_bundle(const std::string& hash, const Blobs& blobs, const std::string& pointer) {
  if (const std::uint64_t size = blobs.size(hash, pointer); size > proto::max_cell_bundle_bytes)
    throw proto::ProtocolError("too_large",
                               "the cell bundle has " + std::to_string(size) + " bytes, over the limit of " +
                                   std::to_string(proto::max_cell_bundle_bytes) +
                                   ": it only lists the files of the cell, by hash",
                               pointer);
  return proto::read_cell_bundle(blobs.read(hash, pointer));
}

}  // namespace

std::string mesh_kind(const std::string& name) {
  return extension_of(name);
}

std::uint64_t measure_cell(const std::string& cell_bundle, const Blobs& blobs, const std::string& pointer) {
  const proto::CellBundle bundle = read_bundle(cell_bundle, blobs, pointer);
  std::uint64_t bytes = bundle.cell_json.size();
  for (const auto& [reference, sha256] : bundle.files) bytes += blobs.size(sha256, pointer);
  return bytes;
}

CellFiles load_cell(const std::string& cell_bundle, const Blobs& blobs, const std::string& pointer) {
  const proto::CellBundle bundle = read_bundle(cell_bundle, blobs, pointer);
  CellFiles files{bundle.name, bundle.cell_json, {}};
  for (const auto& [reference, sha256] : bundle.files) files.files[reference] = blobs.read(sha256, pointer);
  return files;
}

JobSizes measure(const proto::JobSpec& spec, const std::string& cell_bundle, const Blobs& blobs) {
  JobSizes sizes;
  sizes.resolution = static_cast<int>(spec.resolution);
  sizes.mesh = measure(spec.mesh, blobs, mesh_pointer);
  if (spec.stock_mesh) sizes.stock = measure(*spec.stock_mesh, blobs, stock_pointer);
  sizes.cell_bytes = measure_cell(cell_bundle, blobs, cell_pointer);
  for (const proto::ClampingSpec& clamping : spec.clampings)
    sizes.left_bytes += blobs.size(clamping.left, continue_pointer);
  return sizes;
}

Job to_job(const proto::JobSpec& spec, const std::string& cell_bundle, const Blobs& blobs,
           const JobDefaults& defaults) {
  Job job;
  job.mesh = read_mesh(spec.mesh, blobs, mesh_pointer);
  job.cell = load_cell(cell_bundle, blobs, cell_pointer);
  job.resolution = static_cast<int>(spec.resolution);
  if (const auto& mill = spec.mill) {
    job.mill = MillOrder{{"of the job", proto::write_json(mill->library)},
                         mill->tools,
                         mill->tolerance_m,
                         mill->scallop_m,
                         mill->allowance_m};
    job.search = Search::mill;
  }
  if (const auto& motion = spec.motion)
    job.motion = MotionOrder{motion->feed_m_s, motion->rapid_m_s, motion->keep_feed};
  if (spec.search) job.search = parse_search(*spec.search);
  job.seed = spec.seed;
  job.threads = spec.threads.value_or(defaults.threads);
  job.allow_freed = spec.allow_freed;
  job.placement.scale_m = spec.placement.scale_m;
  job.placement.rotation_rad = to_vector(spec.placement.rotation_rad);
  job.placement.offset_m = to_vector(spec.placement.offset_m);
  job.placement.margin_m = spec.placement.margin_m;
  if (spec.stock_box) job.stock.box = Stock::Box{to_vector(spec.stock_box->min_m), to_vector(spec.stock_box->max_m)};
  if (spec.stock_mesh) job.stock.mesh = read_mesh(*spec.stock_mesh, blobs, stock_pointer);
  for (const proto::ClampingSpec& clamping : spec.clampings)
    job.clampings.push_back({{blobs.read(clamping.left, continue_pointer), "binvox", "what the job before left"},
                             to_vector(clamping.rotation_rad)});
  job.memory_cap_bytes = defaults.memory_cap_bytes;
  return job;
}

ProgramDemands to_program_demands(const proto::ProgramSpec& spec) {
  ProgramDemands demands;
  demands.dialect = parse_dialect(spec.dialect);
  demands.name = spec.name;
  if (spec.part_keyframes) demands.part_keyframes = static_cast<std::size_t>(*spec.part_keyframes);
  demands.part_bytes = spec.part_bytes;
  demands.stock_files = spec.stock_files;
  demands.seams_in_stock = spec.seams_in_stock;
  return demands;
}

std::string store_cell(const CellFiles& files, Blobs& blobs) {
  proto::CellBundle bundle{files.name, files.cell_json, {}};
  for (const auto& [reference, bytes] : files.files) bundle.files[reference] = blobs.add(bytes);
  return blobs.add(proto::write_cell_bundle(bundle));
}

}  // namespace sculpt::server
