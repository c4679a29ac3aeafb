// A trajectory file, .ndjson or .sct, in all directions.
#include <sstream>

#include "core/base/error.hpp"
#include "core/trajectory/export.hpp"
#include "tests/fuzz/target.hpp"

void read_hostile(std::string_view bytes) {
  for (const auto convert : {sculpt::export_csv, sculpt::export_binary, sculpt::export_text}) {
    std::istringstream in{std::string(bytes)};
    std::ostringstream out;
    try {
      convert(in, out);
    } catch (const sculpt::InputError&) {
    }
  }
}
