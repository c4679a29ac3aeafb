// A timeline, and what stands half-way through it.
#include "core/base/error.hpp"
#include "core/picture/stock_moment.hpp"
#include "tests/fuzz/target.hpp"

void read_hostile(std::string_view bytes) {
  try {
    (void)sculpt::moment_of_timeline(bytes, 0.5, true);
  } catch (const sculpt::InputError&) {
  }
}
