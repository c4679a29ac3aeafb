#include "core/plan/job_key.hpp"

#include <array>
#include <bit>
#include <fstream>
#include <vector>

#include "core/base/sha256.hpp"

namespace sculpt {
namespace {

class Key {
 public:
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    hash_.add(text);
  }
  void add(std::uint64_t number) {
    const auto bytes = std::bit_cast<std::array<char, sizeof number>>(number);
    hash_.add({bytes.data(), bytes.size()});
  }
  void add(const Vec3& v) {
    for (double value : v) add(std::bit_cast<std::uint64_t>(value));
  }
  void add(const MeshFile& file) {
    add(file.bytes);
    add(file.extension);
    add(file.name);
  }
  std::string hex() { return hash_.hex(); }

 private:
  Sha256 hash_;
};

std::string hash_program() {
  std::ifstream in("/proc/self/exe", std::ios::binary);
  Sha256 hash;
  std::vector<char> buffer(1 << 20);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  return hash.hex();
}

}  // namespace

const std::string& program_hash() {
  static const std::string hash = hash_program();
  return hash;
}

std::string job_key(const Job& job) {
  Key key;
  key.add(program_hash());
  key.add(job.mesh);
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
  key.add(std::bit_cast<std::uint64_t>(job.placement.scale_m.value_or(0)));
  key.add(job.placement.rotation_rad);
  key.add(job.placement.offset_m);
  key.add(std::bit_cast<std::uint64_t>(job.placement.margin_m));
  key.add(static_cast<std::uint64_t>(job.stock.box.has_value()));
  if (job.stock.box) {
    key.add(job.stock.box->min_m);
    key.add(job.stock.box->max_m);
  }
  key.add(static_cast<std::uint64_t>(job.stock.mesh.has_value()));
  if (job.stock.mesh) key.add(*job.stock.mesh);
  key.add(static_cast<std::uint64_t>(job.clampings.size()));
  for (const Clamping& clamping : job.clampings) {
    key.add(clamping.left);
    key.add(clamping.rotation_rad);
  }
  return key.hex();
}

}  // namespace sculpt
