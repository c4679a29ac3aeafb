#include "server/access/tokens.hpp"

#include <openssl/crypto.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/base/sha256.hpp"
#include "proto/fields.hpp"
#include "server/access/secret.hpp"
#include "server/base/config.hpp"
#include "server/files/durable.hpp"

namespace sculpt::server {
namespace {

constexpr std::array scopes{Scope::read, Scope::submit, Scope::admin};
constexpr int secret_bytes = 32;
constexpr int salt_bytes = 16;
constexpr std::size_t max_name_bytes = 64;

std::string salted_hash(const std::string& salt, const std::string& secret) {
  return sha256_hex(salt + secret);
}

Token read_token(proto::Fields fields) {
  Token token;
  token.name = fields.text("name", max_name_bytes);
  token.scope = scope_named(fields.text("scope"));
  token.salt = fields.text("salt");
  token.sha256 = fields.sha256("sha256");
  if (fields.has("expires")) token.expires = fields.text("expires");
  fields.done();
  return token;
}

}  // namespace

const char* name(Scope scope) {
  return scope == Scope::read ? "read" : scope == Scope::submit ? "submit" : "admin";
}

Scope scope_named(const std::string& word) {
  for (const Scope scope : scopes) {
    if (word == name(scope)) return scope;
  }
  throw ConfigError("there is no scope '" + word + "': there are read, submit, admin");
}

std::vector<Token> read_tokens(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) {
    throw ConfigError("cannot read the tokens file '" + file.string() +
                      "': make one with 'sculptd token add NAME --scope read|submit|admin'");
  }
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  try {
    const Json json = proto::parse_json(text);
    proto::Fields fields(json, "");
    const Json& list = fields.value("tokens");
    if (!list.is_array()) fields.refuse("tokens", "must be an array");
    fields.done();
    std::vector<Token> tokens;
    for (const Json& entry : list) {
      tokens.push_back(read_token(proto::Fields(entry, "/tokens/" + std::to_string(tokens.size()))));
    }
    return tokens;
  } catch (const std::runtime_error& error) {
    throw ConfigError("the tokens file '" + file.string() + "': " + error.what());
  }
}

void write_tokens(const std::filesystem::path& file, const std::vector<Token>& tokens) {
  Json list = Json::array();
  for (const Token& token : tokens) {
    Json entry{{"name", token.name}, {"scope", name(token.scope)}, {"salt", token.salt}, {"sha256", token.sha256}};
    if (!token.expires.empty()) entry["expires"] = token.expires;
    list.push_back(std::move(entry));
  }
  const mode_t before = ::umask(077);
  try {
    write_durably(file, Json{{"tokens", std::move(list)}}.dump(2) + "\n");
  } catch (...) {
    ::umask(before);
    throw;
  }
  ::umask(before);
}

std::string make_secret(Token& token) {
  const std::string secret = "sculpt_" + random_hex(secret_bytes);
  token.salt = random_hex(salt_bytes);
  token.sha256 = salted_hash(token.salt, secret);
  return secret;
}

const Token* find_token(const std::vector<Token>& tokens, const std::string& secret, const std::string& now) {
  const Token* found = nullptr;
  for (const Token& token : tokens) {
    const std::string hash = salted_hash(token.salt, secret);
    const bool same = ::CRYPTO_memcmp(hash.data(), token.sha256.data(), hash.size()) == 0;
    if (same && (token.expires.empty() || now < token.expires)) found = &token;
  }
  return found;
}

}  // namespace sculpt::server
