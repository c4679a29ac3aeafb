// Work that is to take what cores others leave idle.
#pragma once

namespace sculpt {

/// For the calling thread, and the threads and processes that it starts from now on. There is no way back: Linux lets
/// nobody but root raise a priority again.
void work_in_background();

}  // namespace sculpt
