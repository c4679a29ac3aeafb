// One fuzz target a file: a reader of bytes from outside. It may refuse them in the way it says, and must do nothing
// else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Defined by each target.
void read_hostile(std::string_view bytes);
