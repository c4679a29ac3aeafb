// The file of bearer tokens: names, scopes and salted hashes, never the tokens themselves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sculpt::server {

/// Each includes those before it.
enum class Scope { read, submit, admin };
const char* name(Scope scope);
/// Throws ConfigError.
Scope scope_named(const std::string& word);

/// A token is 256 random bits, so one salted SHA-256 is enough: nobody can try them all, and a slow hash for weak
/// passwords would only cost time at every hello.
struct Token {
  std::string name;
  Scope scope = Scope::read;
  std::string salt;     ///< 32 hex digits
  std::string sha256;   ///< of salt and token, as hex digits
  std::string expires;  ///< UTC, "2026-01-31T12:00:00.000Z"; empty: never
};

/// Throws ConfigError naming the file and the field.
std::vector<Token> read_tokens(const std::filesystem::path& file);
/// The file can then be read by its owner only. Throws StorageError.
void write_tokens(const std::filesystem::path& file, const std::vector<Token>& tokens);

/// A new token's text, to be shown once; `token` gets salt and hash.
std::string make_secret(Token& token);

/// Takes the same time whatever the secret is. Null: not there, or expired at `now`.
const Token* find_token(const std::vector<Token>& tokens, const std::string& secret, const std::string& now);

}  // namespace sculpt::server
