// What a URDF could do to urdfdom, or be misread as, refused before it is parsed.
#pragma once

#include <string>

namespace sculpt {

/// Throws InputError `urdf_invalid` for a text that is too large, is no XML, nests so deep that a recursive parser runs
/// out of stack, has a document type or control characters in its names, or is a xacro source.
void check_urdf(const std::string& xml);

/// Throws InputError `urdf_invalid`.
[[noreturn]] void refuse_urdf(const std::string& sentence);

}  // namespace sculpt
