#include "core/sweep/field/field_store.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cereal/archives/binary.hpp>
#include <cereal/types/vector.hpp>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/base/content_key.hpp"

namespace Eigen {

template <class Archive, int Rows, int MaxRows>
void save(Archive& archive, const Matrix<double, Rows, 1, 0, MaxRows, 1>& vector) {
  archive(static_cast<std::int64_t>(vector.size()));
  for (const double value : vector) archive(value);
}

template <class Archive, int Rows, int MaxRows>
void load(Archive& archive, Matrix<double, Rows, 1, 0, MaxRows, 1>& vector) {
  std::int64_t size = 0;
  archive(size);
  vector.resize(size);
  for (double& value : vector) archive(value);
}

template <class Archive>
void serialize(Archive& archive, AlignedBox3d& box) {
  archive(box.min(), box.max());
}

}  // namespace Eigen

namespace sculpt {

template <class Archive>
void serialize(Archive& archive, Voxel& voxel) {
  archive(voxel.i, voxel.j, voxel.k);
}

template <class Archive>
void serialize(Archive& archive, JointBox& box) {
  archive(box.low, box.high);
}

template <class Archive>
void serialize(Archive& archive, Bubble::HalfSpace& half_space) {
  archive(half_space.approach, half_space.room_m);
}

template <class Archive>
void serialize(Archive& archive, LatticeCube& cube) {
  archive(cube.corner, cube.size, cube.box, cube.pairs);
}

template <class Archive>
void serialize(Archive& archive, PostureLattice::Start& start) {
  archive(start.q, start.i, start.j);
}

template <class Archive>
void serialize(Archive& archive, PostureField::Record& record) {
  archive(record.start, record.cover, record.roomy);
}

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_bytes = 256u << 20;
constexpr std::size_t hash_length = 64;
constexpr const char* extension = ".fields";

std::string hash_of(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

void drop_oldest(const fs::path& folder) {
  struct Kept {
    fs::file_time_type when;
    std::uintmax_t bytes;
    fs::path file;
  };
  std::vector<Kept> kept;
  std::uintmax_t sum = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != extension) continue;
    kept.push_back({entry.last_write_time(), entry.file_size(), entry.path()});
    sum += kept.back().bytes;
  }
  std::ranges::sort(kept, {}, &Kept::when);
  for (auto oldest = kept.begin(); sum > max_bytes && oldest != kept.end(); ++oldest) {
    fs::remove(oldest->file);
    sum -= oldest->bytes;
  }
}

}  // namespace

std::string field_key(const CellFiles& cell, int resolution, std::uint64_t seed) {
  ContentKey key;
  key.add(program_hash());
  key.add(cell.cell_json);
  for (const auto& [name, bytes] : cell.files) {
    key.add(name);
    key.add(bytes);
  }
  key.add(static_cast<std::uint64_t>(resolution));
  key.add(seed);
  return key.hex();
}

fs::path FieldStore::file_of(std::uint64_t number) const {
  return folder_ / (key_ + "-" + std::to_string(number) + extension);
}

std::optional<std::vector<PostureField::Record>> FieldStore::read(std::uint64_t number) const {
  if (folder_.empty()) return std::nullopt;
  std::ifstream in(file_of(number), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() < hash_length ||
      hash_of(std::string_view(bytes).substr(hash_length)) != bytes.substr(0, hash_length))
    return std::nullopt;
  std::istringstream content(bytes.substr(hash_length));
  std::vector<PostureField::Record> found;
  cereal::BinaryInputArchive archive(content);
  archive(found);
  return found;
}

void FieldStore::write(std::uint64_t number, const std::vector<PostureField::Record>& found) const {
  if (folder_.empty()) return;
  std::ostringstream content;
  cereal::BinaryOutputArchive archive(content);
  archive(found);
  static std::atomic<int> drafts = 0;
  const fs::path draft = folder_ / ("draft-" + std::to_string(::getpid()) + "-" + std::to_string(drafts.fetch_add(1)));
  try {
    fs::create_directories(folder_);
    {
      std::ofstream out(draft, std::ios::binary);
      out << hash_of(content.view()) << content.view();
      out.close();
      if (!out) throw fs::filesystem_error("not written", draft, std::make_error_code(std::errc::io_error));
    }
    fs::rename(draft, file_of(number));
    drop_oldest(folder_);
  } catch (const fs::filesystem_error&) {
    std::error_code ignored;
    fs::remove(draft, ignored);
  }
}

}  // namespace sculpt
