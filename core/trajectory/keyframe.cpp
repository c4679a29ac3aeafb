#include "core/trajectory/keyframe.hpp"

namespace sculpt {

int run_length(const Keyframe& keyframe) {
  if (!keyframe.cut) return 0;
  return keyframe.mill ? static_cast<int>(keyframe.mill->removed) : l1(keyframe.first, keyframe.last) + 1;
}

}  // namespace sculpt
