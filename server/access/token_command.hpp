// sculptd token add|list|remove: the operator's side of the tokens file.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace CLI {
class App;
}

namespace sculpt::server {

struct TokenCommand {
  enum class Verb { none, add, list, remove };
  Verb verb = Verb::none;
  std::string name, scope;
  int days = 0;  ///< 0: valid for ever
};

void add_token_command(CLI::App& app, TokenCommand& command);

/// Changes the file (none yet: makes it) or prints from it. A new token is printed here and nowhere else. Throws
/// ConfigError, StorageError.
void run_token_command(const TokenCommand& command, const std::filesystem::path& file, std::ostream& out);

}  // namespace sculpt::server
