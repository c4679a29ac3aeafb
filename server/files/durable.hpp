// Writing so that it stays written: syncs, whole files, and what a failure of the disk means.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sculpt::server {

/// A sync failed with EIO: the kernel may have dropped what it held, and a second try would hide that. Logs, and ends
/// the process with EX_IOERR: everything acknowledged is on disk, and the next daemon reads it from there. Any thread.
[[noreturn]] void end_after_failed_sync(const std::string& what);

/// Throws StorageFull or StorageError, by the errno of a call that failed.
[[noreturn]] void fail_to_store(int error, const std::string& what);

// Both throw StorageError and end the process as above.
/// Makes a file's content durable, and a folder's entries.
void sync_to_disk(const std::filesystem::path& file_or_folder);
/// What a file is called until it is written as a whole: another name in each process, for some share a folder.
std::filesystem::path draft_of(const std::filesystem::path& file);
/// Writes a whole file so that it is there completely or not at all, also after a power cut.
void write_durably(const std::filesystem::path& file, std::string_view bytes);
/// Removes what a process that died left of files that it was writing as a whole, in this folder alone.
void remove_drafts_in(const std::filesystem::path& folder);

}  // namespace sculpt::server
