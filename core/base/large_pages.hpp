// Memory for bits of whole grids: at 1024^3 a set of voxels is 128 MB, and to be given them in pages of 4 KiB takes the
// kernel longer than most of what is done with them.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace sculpt {

/// An allocator that asks for pages of 2 MiB (MADV_HUGEPAGE) where a block is several of them; where the kernel has
/// none it gives ordinary ones.
template <typename T>
struct LargePages {
  using value_type = T;

  LargePages() = default;
  template <typename Other>
  LargePages(const LargePages<Other>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < few) return static_cast<T*>(::operator new(bytes));
    // Not from the heap: what is given back there may stay with the process.
    const std::size_t whole = whole_pages(bytes);
    void* const mapped = ::mmap(nullptr, whole + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    auto* const begin = static_cast<std::byte*>(mapped);
    const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
    if (before > 0) ::munmap(begin, before);
    if (before < page) ::munmap(begin + before + whole, page - before);
    ::madvise(begin + before, whole, MADV_HUGEPAGE);
    return reinterpret_cast<T*>(begin + before);
  }
  void deallocate(T* memory, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < few)
      ::operator delete(memory);
    else
      ::munmap(memory, whole_pages(bytes));
  }

  bool operator==(const LargePages&) const = default;

 private:
  static constexpr std::size_t page = std::size_t{2} << 20, few = 4 * page;

  static std::size_t whole_pages(std::size_t bytes) { return (bytes + page - 1) / page * page; }
};

/// Bits, 64 in a word.
using Words = std::vector<std::uint64_t, LargePages<std::uint64_t>>;

}  // namespace sculpt
