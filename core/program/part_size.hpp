// How large a part of a program may be, and how many moves that is. Internal to core/program.
#pragma once

#include <cstdint>
#include <vector>

#include "core/program/write/part_writer.hpp"

namespace sculpt {

/// What the texts of parts take, in bytes.
struct TextSize {
  std::uint64_t most = 0;            ///< that a part may have; 0: any number
  std::uint64_t frame = 0;           ///< besides its moves, at most
  std::uint64_t retreat = 0;         ///< of a move of a retreat, at most
  std::vector<std::uint64_t> until;  ///< by point of the path: of all moves up to there, at most
};

/// What a part is at most.
struct PartSize {
  std::size_t moves = 0;       ///< those of the retreats at both ends included; 0: no limit
  bool may_be_inside = false;  ///< parts end after that many moves wherever the tool is
  TextSize text = {};

  /// Whether a part may have `moves` of the path from point `begin` on, behind `returning` moves that come back from a
  /// retreat, and then `leaving` ones that leave the material.
  bool fits(std::size_t begin, std::size_t returning, std::size_t moves, std::size_t leaving) const;
  /// Of the path, as many as fit, `most` at most.
  std::size_t moves_from(std::size_t begin, std::size_t returning, std::size_t most) const;
};

/// Finds out what the moves of a path take when they are written, without keeping their texts.
class TextMeter {
 public:
  /// `names`: with the longest mount that there is. `layout` must outlive it.
  TextMeter(Dialect dialect, const AxisLayout& layout, ProgramNames names, const Configuration& home);
  /// In their order, from that to point 1 on.
  void add(const ProgramMove& move);
  TextSize take(std::uint64_t most);

 private:
  std::unique_ptr<PartWriter> writer() const;

  const Dialect dialect_;
  const AxisLayout& layout_;
  ProgramNames names_;
  const Configuration home_;
  TextSize size_;
  std::unique_ptr<PartWriter> writer_;
  std::size_t in_writer_ = 0;  ///< moves
};

}  // namespace sculpt
