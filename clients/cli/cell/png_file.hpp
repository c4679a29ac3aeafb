// A picture as a PNG file. The only door to libpng.
#pragma once

#include <filesystem>

#include "core/picture/canvas.hpp"

namespace sculpt::cli {

/// Throws Failure (usage) `file_unwritable`.
void write_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace sculpt::cli
