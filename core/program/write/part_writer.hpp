// The text of a program in each dialect.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/program/axis_layout.hpp"
#include "core/program/program_move.hpp"

namespace sculpt {

struct ProgramFile {
  std::string name, text;
};

/// A tool that a hand or a changer puts into the spindle.
struct ToolMount {
  int number = 0;
  std::string name;
  /// ASCII letters, digits and blanks.
  std::string text() const;
};

/// Voxels that are removed before a part, and with it.
struct VoxelsCut {
  std::uint64_t before = 0, after = 0;
  /// One of them as a comment.
  std::string text_before() const;
  std::string text_after() const;
};

/// What the texts of a program's parts share.
struct ProgramNames {
  std::string program;              ///< a word: letters, digits, _; begins with a letter
  std::size_t part = 0, parts = 0;  ///< from 1 on
  std::optional<ToolMount> mount;   ///< that the part stops for before anything moves
  VoxelsCut voxels = {};
  std::string part_name() const;
};

/// One part: begins at rest at `start`, which it checks before it moves, and ends at rest. Throws InputError
/// `speed_too_coarse` where the dialect cannot say a speed so low.
class PartWriter {
 public:
  virtual ~PartWriter() = default;
  virtual void add(const ProgramMove& move) = 0;
  /// Of what was written so far.
  virtual std::uint64_t bytes() const = 0;
  /// The files of the part.
  virtual std::vector<ProgramFile> finish() = 0;
};

std::unique_ptr<PartWriter> write_part(Dialect dialect, const AxisLayout& layout, const ProgramNames& names,
                                       const Configuration& start);
/// The program that calls the parts and remembers which is next, where the dialect has one.
std::vector<ProgramFile> write_main(Dialect dialect, const std::string& program, std::size_t parts);

/// Of each dialect; internal to write/.
std::unique_ptr<PartWriter> krl_part(const AxisLayout& layout, const ProgramNames& names, const Configuration& start);
std::unique_ptr<PartWriter> rapid_part(const AxisLayout& layout, const ProgramNames& names, const Configuration& start);
std::unique_ptr<PartWriter> urscript_part(const AxisLayout& layout, const ProgramNames& names,
                                          const Configuration& start);
std::unique_ptr<PartWriter> fanuc_part(const AxisLayout& layout, const ProgramNames& names, const Configuration& start);
std::unique_ptr<PartWriter> gcode_part(const AxisLayout& layout, const ProgramNames& names, const Configuration& start);

}  // namespace sculpt
