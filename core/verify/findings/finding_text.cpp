#include "core/verify/findings/finding_text.hpp"

#include <sstream>

namespace sculpt {

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string text(Voxel v) {
  return "(" + std::to_string(v.i) + ", " + std::to_string(v.j) + ", " + std::to_string(v.k) + ")";
}

}  // namespace sculpt
