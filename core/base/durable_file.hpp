// Files that are still there after a power cut.
#pragma once

#include <filesystem>
#include <string_view>

namespace sculpt {

/// Waits until what was written to a file, or the names in a folder, are on the disk. Throws InputError
/// `file_unwritable`.
void sync_file(const std::filesystem::path& path);

/// `file` holds `bytes`, durably, or what it held before: never a part. Throws InputError `file_unwritable`.
void replace_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace sculpt
