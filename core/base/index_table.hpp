// Numbers with a value each, for searches that are done a million times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sculpt {

/// A hash table with linear probing in one block of memory that is kept from search to search: forgetting all costs
/// nothing. (std::unordered_map takes memory for every number.)
template <class Value>
class IndexTable {
 public:
  /// The value of `index` (below 2^32), Value{} if it is new, and whether it is. The reference holds until the next
  /// call.
  std::pair<Value&, bool> enter(std::size_t index) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slot_of(static_cast<std::uint32_t>(index));
    const bool is_new = slot.round != round_;
    if (is_new) {
      slot = {static_cast<std::uint32_t>(index), round_, {}};
      ++size_;
    }
    return {slot.value, is_new};
  }
  std::size_t size() const { return size_; }
  void clear() {
    size_ = 0;
    if (++round_ != 0) return;
    slots_.assign(slots_.size(), {});
    round_ = 1;
  }

 private:
  struct Slot {
    std::uint32_t index = 0, round = 0;
    Value value{};
  };

  Slot& slot_of(std::uint32_t index) {
    const std::size_t last = slots_.size() - 1;
    std::size_t at = (index * std::uint64_t{0x9E3779B97F4A7C15} >> 32) & last;
    while (slots_[at].round == round_ && slots_[at].index != index) at = (at + 1) & last;
    return slots_[at];
  }
  void grow() {
    std::vector<Slot> before(slots_.empty() ? 256 : 2 * slots_.size());
    before.swap(slots_);
    for (const Slot& slot : before)
      if (slot.round == round_) slot_of(slot.index) = slot;
  }

  std::vector<Slot> slots_;  ///< a power of two; those of other rounds are free
  std::uint32_t round_ = 1;
  std::size_t size_ = 0;
};

}  // namespace sculpt
