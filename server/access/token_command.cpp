#include "server/access/token_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>

#include "server/access/tokens.hpp"
#include "server/base/config.hpp"
#include "server/base/time_stamp.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr int max_days = 36500;
constexpr std::uint64_t day_ms = 86'400'000;

void add_token(const TokenCommand& command, const fs::path& file, std::vector<Token> tokens, std::ostream& out) {
  if (std::ranges::find(tokens, command.name, &Token::name) != tokens.end()) {
    throw ConfigError("there is a token '" + command.name + "' already: remove it first, or choose another name");
  }
  Token token;
  token.name = command.name;
  token.scope = scope_named(command.scope);
  if (command.days > 0) token.expires = utc_text(unix_ms() + static_cast<std::uint64_t>(command.days) * day_ms);
  const std::string secret = make_secret(token);
  tokens.push_back(std::move(token));
  write_tokens(file, tokens);
  out << secret << "\n";
}

void remove_token(const TokenCommand& command, const fs::path& file, std::vector<Token> tokens) {
  if (std::erase_if(tokens, [&](const Token& token) { return token.name == command.name; }) == 0) {
    throw ConfigError("there is no token '" + command.name + "' in '" + file.string() + "': see 'sculptd token list'");
  }
  write_tokens(file, tokens);
}

}  // namespace

void add_token_command(CLI::App& app, TokenCommand& command) {
  using Verb = TokenCommand::Verb;
  CLI::App* token = app.add_subcommand("token", "add, list or remove the tokens that clients must show")->fallthrough();
  token->require_subcommand(1);
  CLI::App* add = token->add_subcommand("add", "make a token and print it: it is shown only now")->fallthrough();
  add->add_option("NAME", command.name, "who will use it: the owner of what is done with it")->required();
  add->add_option("--scope", command.scope, "read (look), submit (look and give work) or admin (everything)")
      ->required()
      ->check(CLI::IsMember({"read", "submit", "admin"}));
  add->add_option("--days", command.days, "how long it is valid, default for ever")->check(CLI::Range(1, max_days));
  add->callback([&command] { command.verb = Verb::add; });
  CLI::App* list = token->add_subcommand("list", "print names, scopes and ends")->fallthrough();
  list->callback([&command] { command.verb = Verb::list; });
  CLI::App* remove = token->add_subcommand("remove", "make a token worthless")->fallthrough();
  remove->add_option("NAME", command.name)->required();
  remove->callback([&command] { command.verb = Verb::remove; });
}

void run_token_command(const TokenCommand& command, const fs::path& file, std::ostream& out) {
  if (file.empty())
    throw ConfigError("no tokens file is named: set \"tokens\" in the config file or say --tokens FILE");
  const fs::path path = fs::absolute(file);
  std::vector<Token> tokens;
  if (fs::exists(path)) tokens = read_tokens(path);
  if (command.verb == TokenCommand::Verb::add) return add_token(command, path, std::move(tokens), out);
  if (command.verb == TokenCommand::Verb::remove) return remove_token(command, path, std::move(tokens));
  for (const Token& token : tokens) {
    out << token.name << "\t" << name(token.scope) << "\t" << (token.expires.empty() ? "never" : token.expires) << "\n";
  }
}

}  // namespace sculpt::server
