// The csv and binary forms of a trajectory: made from the final one when first asked for, each with its seal beside it
// (FILE.seal). Without a good seal a form counts as not made; it is always made alike.
#pragma once

#include <filesystem>
#include <optional>

#include "server/files/stored_file.hpp"

namespace sculpt::server {

/// What FOLDER/JOB/NAME was sealed with; nothing if there is no seal, or the file has another size.
std::optional<FileSeal> read_seal(const std::filesystem::path& folder, const std::string& job, const std::string& name);
/// Of a file as it is now, durably. Throws StorageError.
void write_seal(const std::filesystem::path& folder, const std::string& job, const std::string& name);
/// The file counts as not made from now on.
void break_seal(const std::filesystem::path& folder, const std::string& job, const std::string& name);

}  // namespace sculpt::server
