// An uploaded cell bundle.
#include "proto/cell_bundle.hpp"

#include "proto/error_codes.hpp"
#include "tests/fuzz/target.hpp"

void read_hostile(std::string_view bytes) {
  try {
    sculpt::proto::write_cell_bundle(sculpt::proto::read_cell_bundle(bytes));
  } catch (const sculpt::proto::ProtocolError&) {
  }
}
