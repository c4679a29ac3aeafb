// A .binvox file.
#include "core/material/binvox.hpp"

#include "core/base/error.hpp"
#include "tests/fuzz/target.hpp"

void read_hostile(std::string_view bytes) {
  try {
    sculpt::read_binvox(bytes);
  } catch (const sculpt::InputError&) {
  }
}
