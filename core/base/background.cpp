#include "core/base/background.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace sculpt {

// Linux keeps a nice value for each thread, which POSIX knows for whole processes only. 0 is the calling thread.
void work_in_background() {
  constexpr int more = 10, most = 19;
  setpriority(PRIO_PROCESS, 0, std::min(getpriority(PRIO_PROCESS, 0) + more, most));
}

}  // namespace sculpt
