#include "core/program/dialect.hpp"

#include <array>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

constexpr std::array<DialectFacts, 6> all{{{"krl", ".src", 5000, true, 6, true},
                                           {"rapid", ".mod", 10000, true, 6, true},
                                           {"urscript", ".script", 1000, true, 0, false},
                                           {"fanuc", ".ls", 5000, true, 3, true, 3},
                                           {"gcode", ".ngc", 0, false, 0, true},
                                           {"ros2", ".yaml", 0, false, 0, false}}};

}  // namespace

const DialectFacts& facts_of(Dialect dialect) {
  return all[static_cast<std::size_t>(dialect)];
}

Dialect parse_dialect(const std::string& name) {
  std::string names;
  for (std::size_t at = 0; at < all.size(); ++at) {
    if (name == all[at].name) return static_cast<Dialect>(at);
    names += (names.empty() ? "" : ", ") + std::string(all[at].name);
  }
  throw InputError("dialect_unknown", "no dialect is called '" + name + "': known are " + names);
}

}  // namespace sculpt
