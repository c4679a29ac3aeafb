// A length for a sentence.
#pragma once

#include <string>

namespace sculpt {

/// "0.025 m": three digits.
std::string in_metres(double metres);

}  // namespace sculpt
