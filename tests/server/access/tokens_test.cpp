#include "server/access/tokens.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "server/access/token_command.hpp"
#include "server/base/config.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

const std::string now = "2000-01-01T00:00:00.000Z";

class Tokens : public testing::Test {
 protected:
  std::string run(TokenCommand command) {
    std::ostringstream out;
    run_token_command(command, file, out);
    return out.str();
  }
  std::string add(const std::string& name, const std::string& scope, int days = 0) {
    std::string secret = run({TokenCommand::Verb::add, name, scope, days});
    secret.pop_back();
    return secret;
  }
  std::string content() {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "tokens.json";
};

TEST_F(Tokens, ATokenIsFoundByItsTextAloneAndTheFileDoesNotHoldIt) {
  const std::string cell = add("cell-7", "submit"), boss = add("boss", "admin");
  const std::vector<Token> tokens = read_tokens(file);
  ASSERT_NE(find_token(tokens, cell, now), nullptr);
  EXPECT_EQ(find_token(tokens, cell, now)->name, "cell-7");
  EXPECT_EQ(find_token(tokens, boss, now)->scope, Scope::admin);
  EXPECT_EQ(find_token(tokens, cell + "x", now), nullptr);
  EXPECT_EQ(find_token(tokens, tokens.front().sha256, now), nullptr);
  EXPECT_EQ(find_token(tokens, "", now), nullptr);
  EXPECT_EQ(content().find(cell.substr(8)), std::string::npos);
}

TEST_F(Tokens, OnlyTheOwnerMayReadTheFile) {
  add("cell-7", "read");
  using std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(file).permissions(), perms::owner_read | perms::owner_write);
}

TEST_F(Tokens, AnEndIsKept) {
  const std::string secret = add("visitor", "read", 1);
  const std::vector<Token> tokens = read_tokens(file);
  EXPECT_NE(find_token(tokens, secret, now), nullptr);
  EXPECT_EQ(find_token(tokens, secret, tokens.front().expires), nullptr);
}

TEST_F(Tokens, ListAndRemove) {
  const std::string secret = add("cell-7", "read");
  add("boss", "admin");
  EXPECT_EQ(run({TokenCommand::Verb::list, {}, {}, 0}), "cell-7\tread\tnever\nboss\tadmin\tnever\n");
  EXPECT_THROW(add("boss", "read"), ConfigError) << "a name is used once";
  run({TokenCommand::Verb::remove, "cell-7", {}, 0});
  EXPECT_EQ(find_token(read_tokens(file), secret, now), nullptr);
  EXPECT_THROW(run({TokenCommand::Verb::remove, "cell-7", {}, 0}), ConfigError);
}

TEST_F(Tokens, ABrokenFileIsRefusedWithItsPlace) {
  EXPECT_THROW(read_tokens(file), ConfigError);
  for (const char* broken : {"", "[]", R"({"tokens":{}})", R"({"tokens":[{"name":"x"}]})",
                             R"({"tokens":[{"name":"x","scope":"all","salt":"","sha256":""}]})", R"({"tokens":[7]})"}) {
    std::ofstream(file) << broken;
    try {
      read_tokens(file);
      ADD_FAILURE() << broken;
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace sculpt::server
