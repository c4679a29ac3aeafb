// libFuzzer's door to a target.
#include "tests/fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  read_hostile({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
