#include "core/trajectory/keyframe.hpp"

namespace sculpt {

int run_length(const Keyframe& keyframe) {
  return keyframe.cut ? l1(keyframe.first, keyframe.last) + 1 : 0;
}

}  // namespace sculpt
