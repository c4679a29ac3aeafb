#include "server/background.hpp"

#include <sys/resource.h>

namespace sculpt {

// Linux keeps a nice value for each thread, which POSIX knows for whole processes only. 0 is the calling thread.
void work_in_background() {
  constexpr int nice = 10;
  setpriority(PRIO_PROCESS, 0, nice);
}

}  // namespace sculpt
