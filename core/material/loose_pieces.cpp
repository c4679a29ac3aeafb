#include "core/material/loose_pieces.hpp"

#include <algorithm>

#include "core/material/cavities.hpp"
#include "core/material/flood.hpp"

namespace sculpt {
namespace {

/// From one voxel of the line to the next, from `from` to `to`.
Voxel step_between(Voxel from, Voxel to) {
  const auto sign = [](int value) { return (value > 0) - (value < 0); };
  return {sign(to.i - from.i), sign(to.j - from.j), sign(to.k - from.k)};
}

struct Erased {
  std::uint64_t all = 0, unforeseen = 0;
};

/// Erases the voxels of `set` that face-connected paths inside it join to a neighbour of `start`; returns how many, and
/// how many of them are not in `foreseen`.
Erased erase_beside(VoxelSet& set, Voxel start, const VoxelSet& foreseen, std::vector<Voxel>& stack) {
  const Grid bounds{set.n(), 1, Vec3::Zero()};
  Erased erased;
  stack.assign(1, start);
  while (!stack.empty()) {
    const Voxel here = stack.back();
    stack.pop_back();
    for (Voxel step : face_steps) {
      const Voxel beside = here + step;
      if (!bounds.contains(beside) || !set.contains(beside)) continue;
      set.erase(beside);
      ++erased.all;
      erased.unforeseen += !foreseen.contains(beside);
      stack.push_back(beside);
    }
  }
  return erased;
}

/// The carving run backwards: material comes back voxel by voxel. What is held then stays held, so a voxel turns from
/// loose to held at most once, and all of it costs one flood.
class Refill {
 public:
  Refill(VoxelSet left, const VoxelSet& may_fall)
      : may_fall_(may_fall), bounds_{left.n(), 1, Vec3::Zero()}, loose_(find_loose(left)), standing_(std::move(left)) {
    pieces_.most = loose_count_ = loose_.size();
  }

  void add(const VoxelLine& line, std::size_t number) {
    const Voxel step = step_between(line.last, line.first);
    const int steps = l1(line.first, line.last);
    bool held = false;  // so is all that follows in the line: its neighbour is
    for (int at = 0; at <= steps; ++at) {
      const Voxel voxel = line.last + step * at;
      standing_.insert(voxel);
      held = held || is_held(voxel);
      if (!held) {
        loose_.insert(voxel);
        pieces_.most = std::max(pieces_.most, ++loose_count_);
      } else if (loose_count_ > 0) {
        const Erased freed = erase_beside(loose_, voxel, may_fall_, stack_);
        if (freed.all > 0) pieces_.loosenings.push_back({number, voxel, freed.all, freed.unforeseen});
        loose_count_ -= freed.all;
      }
    }
  }

  LoosePieces finish() {
    pieces_.at_start = loose_count_;
    std::reverse(pieces_.loosenings.begin(), pieces_.loosenings.end());
    return std::move(pieces_);
  }

 private:
  bool is_held(Voxel voxel) const {
    if (voxel.k == 0) return true;
    return std::any_of(face_steps.begin(), face_steps.end(), [&](Voxel step) {
      const Voxel beside = voxel + step;
      return bounds_.contains(beside) && standing_.contains(beside) && !loose_.contains(beside);
    });
  }

  const VoxelSet& may_fall_;
  Grid bounds_;
  VoxelSet loose_, standing_;
  std::uint64_t loose_count_ = 0;
  LoosePieces pieces_;
  std::vector<Voxel> stack_;
};

}  // namespace

VoxelSet find_loose(const VoxelSet& standing) {
  VoxelSet loose = flood(standing, FloodFrom::floor);
  for (std::size_t at = 0; at < loose.words().size(); ++at)
    loose.words()[at] = standing.words()[at] & ~loose.words()[at];
  return loose;
}

VoxelSet find_unheld(const VoxelGrid& voxels) {
  VoxelSet finished = find_enclosed(voxels);
  for (std::size_t at = 0; at < finished.words().size(); ++at) finished.words()[at] |= voxels.keep.words()[at];
  return find_loose(finished);
}

std::uint64_t count_pieces(const VoxelSet& voxels) {
  VoxelSet rest = voxels;
  const auto n = static_cast<std::size_t>(rest.n());
  std::vector<Voxel> stack;
  std::uint64_t pieces = 0;
  for (std::size_t word = 0; word < rest.words().size(); ++word)
    while (rest.words()[word] != 0) {
      const std::size_t at = 64 * word + static_cast<std::size_t>(std::countr_zero(rest.words()[word]));
      const Voxel start{static_cast<int>(at % n), static_cast<int>(at / n % n), static_cast<int>(at / n / n)};
      rest.erase(start);
      erase_beside(rest, start, rest, stack);
      ++pieces;
    }
  return pieces;
}

LoosePieces find_loose_pieces(const VoxelSet& stock, const std::vector<VoxelLine>& lines) {
  return find_loose_pieces(stock, VoxelSet(stock.n()), lines.size(),
                           [&lines](std::size_t number) { return lines[number]; });
}

LoosePieces find_loose_pieces(const VoxelSet& stock, const VoxelSet& may_fall, std::size_t lines,
                              const std::function<VoxelLine(std::size_t)>& line) {
  VoxelSet left = stock;
  for (std::size_t number = 0; number < lines; ++number) {
    const VoxelLine removed = line(number);
    const Voxel step = step_between(removed.first, removed.last);
    for (int at = l1(removed.first, removed.last); at >= 0; --at) left.erase(removed.first + step * at);
  }
  Refill refill(std::move(left), may_fall);
  for (std::size_t number = lines; number-- > 0;) refill.add(line(number), number);
  return refill.finish();
}

}  // namespace sculpt
