// In which form a trajectory file is written.
#pragma once

namespace sculpt {

enum class TrajectoryForm { text, binary };  // .ndjson, .sct

}  // namespace sculpt
