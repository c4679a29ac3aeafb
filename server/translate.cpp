#include "server/translate.hpp"

#include <algorithm>
#include <cctype>

namespace sculpt {
namespace {

Vec3 to_vector(const std::array<double, 3>& values) {
  return {values[0], values[1], values[2]};
}

MeshFile read_mesh(const BlobRef& ref, const Blobs& blobs, const std::string& pointer) {
  std::string extension = std::filesystem::path(ref.name).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension.empty()) {
    throw ProtocolError(
        "params_invalid",
        "the mesh name '" + ref.name + "' has no extension, so its kind is unknown: name it as the file is named",
        pointer + "/name");
  }
  return {blobs.read(ref.sha256, pointer + "/blob"), extension, ref.name};
}

CellFiles read_cell(const std::string& hash, const Blobs& blobs) {
  const std::string pointer = "/params/spec/robot/cell/blob";
  const CellBundle bundle = read_cell_bundle(blobs.read(hash, pointer));
  CellFiles files{bundle.name, bundle.cell_json, {}};
  for (const auto& [reference, sha256] : bundle.files) files.files[reference] = blobs.read(sha256, pointer);
  return files;
}

}  // namespace

Job to_job(const JobSpec& spec, const std::string& cell_bundle, const Blobs& blobs, const JobDefaults& defaults) {
  Job job;
  job.mesh = read_mesh(spec.mesh, blobs, "/params/spec/mesh");
  job.cell = read_cell(cell_bundle, blobs);
  job.resolution = static_cast<int>(spec.resolution);
  if (spec.search) job.search = *spec.search;
  job.seed = spec.seed;
  job.threads = spec.threads.value_or(defaults.threads);
  job.allow_freed = spec.allow_freed;
  job.placement.scale_m = spec.placement.scale_m;
  job.placement.rotation_rad = to_vector(spec.placement.rotation_rad);
  job.placement.offset_m = to_vector(spec.placement.offset_m);
  job.placement.margin_m = spec.placement.margin_m;
  if (spec.stock_box) job.stock.box = Stock::Box{to_vector(spec.stock_box->min_m), to_vector(spec.stock_box->max_m)};
  if (spec.stock_mesh) job.stock.mesh = read_mesh(*spec.stock_mesh, blobs, "/params/spec/stock/mesh");
  job.memory_cap_bytes = defaults.memory_cap_bytes;
  return job;
}

std::string store_cell(const CellFiles& files, Blobs& blobs) {
  CellBundle bundle{files.name, files.cell_json, {}};
  for (const auto& [reference, bytes] : files.files) bundle.files[reference] = blobs.add(bytes);
  return blobs.add(write_cell_bundle(bundle));
}

}  // namespace sculpt
