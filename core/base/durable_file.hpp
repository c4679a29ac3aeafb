// Files that are still there after a power cut.
#pragma once

#include <filesystem>
#include <string_view>

namespace sculpt {

// Both throw InputError `file_unwritable`, and SyncError.
/// Waits until what was written to a file, or the names in a folder, are on the disk.
void sync_file(const std::filesystem::path& path);

/// Has the disk begin with what was written to a file, so that sync_file has less to wait for. Neither waits nor
/// promises anything.
void start_sync(const std::filesystem::path& path);

/// `file` holds `bytes`, durably, or what it held before: never a part.
void replace_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace sculpt
