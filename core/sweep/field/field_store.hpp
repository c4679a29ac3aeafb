// Fields that were found once, kept in a folder for later runs of the same program in the same cell.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/sweep/field/posture_field.hpp"

namespace sculpt {

/// Of all that the fields of a cell depend on where the whole grid is clamped, the running program among it; hex.
std::string field_key(const CellFiles& cell, int resolution, std::uint64_t seed);

/// What a search found is kept in a file of its own, with a hash of its bytes: what is damaged counts as not there.
/// Runs with a store and without give the same fields, bit by bit. Any thread; several processes may share a folder.
class FieldStore {
 public:
  /// Keeps nothing.
  FieldStore() = default;
  /// `key` stands for all that fields depend on, the program among it (field_key). The folder is made when
  /// something is written.
  FieldStore(std::filesystem::path folder, std::string key) : folder_(std::move(folder)), key_(std::move(key)) {}

  /// What the search of this number found; nothing where that is not known.
  std::optional<std::vector<PostureField::Record>> read(std::uint64_t number) const;
  /// Whether there is a file of it, damaged or not.
  bool has(std::uint64_t number) const { return !folder_.empty() && std::filesystem::exists(file_of(number)); }
  /// Where that fails nothing is kept. The oldest files go once all of them are larger than 256 MB.
  void write(std::uint64_t number, const std::vector<PostureField::Record>& found) const;

 private:
  std::filesystem::path file_of(std::uint64_t number) const;

  std::filesystem::path folder_;
  std::string key_;
};

}  // namespace sculpt
