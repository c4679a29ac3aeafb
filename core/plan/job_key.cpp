#include "core/plan/job_key.hpp"

#include "core/base/content_key.hpp"

namespace sculpt {
namespace {

void add(ContentKey& key, const MeshFile& file) {
  key.add(file.bytes);
  key.add(file.extension);
  key.add(file.name);
}

}  // namespace

std::string job_key(const Job& job) {
  ContentKey key;
  key.add(program_hash());
  add(key, job.mesh);
  key.add(job.cell.name);
  key.add(job.cell.cell_json);
  for (const auto& [name, bytes] : job.cell.files) {
    key.add(name);
    key.add(bytes);
  }
  key.add(static_cast<std::uint64_t>(job.resolution));
  key.add(std::string_view(name(job.search)));
  key.add(job.seed);
  key.add(static_cast<std::uint64_t>(job.allow_freed));
  key.add(static_cast<std::uint64_t>(job.placement.scale_m.has_value()));
  key.add(job.placement.scale_m.value_or(0));
  key.add(job.placement.rotation_rad);
  key.add(job.placement.offset_m);
  key.add(job.placement.margin_m);
  key.add(static_cast<std::uint64_t>(job.stock.box.has_value()));
  if (job.stock.box) {
    key.add(job.stock.box->min_m);
    key.add(job.stock.box->max_m);
  }
  key.add(static_cast<std::uint64_t>(job.stock.mesh.has_value()));
  if (job.stock.mesh) add(key, *job.stock.mesh);
  key.add(static_cast<std::uint64_t>(job.clampings.size()));
  for (const Clamping& clamping : job.clampings) {
    add(key, clamping.left);
    key.add(clamping.rotation_rad);
  }
  key.add(static_cast<std::uint64_t>(job.mill.has_value()));
  if (const auto& mill = job.mill) {
    key.add(mill->library.json);
    for (const std::string& tool : mill->tools) key.add(tool);
    key.add(mill->tolerance_m);
    key.add(mill->scallop_m.value_or(0));
    key.add(mill->allowance_m.value_or(0));
  }
  return key.hex();
}

}  // namespace sculpt
