#include "server/base/config.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "server/base/settled_config.hpp"
#include "server/files/data_folder.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

std::string config_refusal(const std::string& text) {
  const TempFolder folder;
  std::ofstream(folder.path() / "server.json") << text;
  Config config;
  try {
    read_config(folder.path() / "server.json", config);
    return "accepted";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

TEST(Config, TheShippedFileIsGoodAndSaysTheDefaults) {
  Config config;
  config.port = 1;
  config.workers = 9;
  read_config(std::string(SOURCE_DIR) + "/config/server.json", config);
  const Config plain;
  EXPECT_EQ(config.host, plain.host);
  EXPECT_EQ(config.port, plain.port);
  EXPECT_EQ(config.workers, plain.workers);
  EXPECT_EQ(config.log, plain.log);
  EXPECT_EQ(config.blob_limit_bytes, plain.blob_limit_bytes);
  EXPECT_EQ(config.memory_cap_bytes, plain.memory_cap_bytes);
  EXPECT_EQ(config.reply_limit_bytes, plain.reply_limit_bytes);
  EXPECT_EQ(config.stall, plain.stall);
  EXPECT_EQ(config.hello_time, plain.hello_time);
  EXPECT_EQ(config.max_connections, plain.max_connections);
  EXPECT_EQ(config.max_connections_per_owner, plain.max_connections_per_owner);
  EXPECT_EQ(config.disk_floor_bytes, plain.disk_floor_bytes);
  EXPECT_EQ(config.host_names, plain.host_names);
  EXPECT_EQ(config.origins, plain.origins);
}

TEST(Config, MistakesAreNamed) {
  EXPECT_EQ(config_refusal("{}"), "accepted");
  EXPECT_NE(config_refusal("{").find("parse error"), std::string::npos);
  EXPECT_NE(config_refusal(R"({"lisen":"x"})").find("/lisen is not known; the nearest setting is listen;"),
            std::string::npos);
  EXPECT_NE(config_refusal(R"({"log":"loud"})").find("/log must be one of trace, debug"), std::string::npos);
  EXPECT_NE(config_refusal("[]").find("must be an object"), std::string::npos);
  EXPECT_NE(config_refusal(R"({"workers":"2"})").find("/workers"), std::string::npos);
  EXPECT_NE(config_refusal(R"({"listen":"7878"})").find("HOST:PORT"), std::string::npos);
}

TEST(Config, ListenTakesHostsAndPorts) {
  Config config;
  set_listen("0.0.0.0:0", config);
  EXPECT_EQ(config.host, "0.0.0.0");
  EXPECT_EQ(config.port, 0);
  set_listen("[::1]:65535", config);
  EXPECT_EQ(config.host, "::1");
  EXPECT_EQ(config.port, 65535);
  for (const char* bad : {"", ":", ":1", "a:", "a:65536", "a:-1", "a:1x", "localhost"}) {
    EXPECT_THROW(set_listen(bad, config), ConfigError) << bad;
  }
}

TEST(DataFolder, BelongsToOneDaemonAtATime) {
  const TempFolder folder;
  {
    const DataFolder first(folder.path());
    EXPECT_THROW(DataFolder second(folder.path(), std::chrono::milliseconds(20)), DataFolderError);
  }
  EXPECT_NO_THROW(DataFolder third(folder.path()));
}

TEST(DataFolder, AFolderThatCannotBeMadeIsNamed) {
  const TempFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  try {
    const DataFolder data(folder.path() / "file" / "data");
    FAIL();
  } catch (const DataFolderError& error) {
    EXPECT_NE(std::string(error.what()).find((folder.path() / "file" / "data").string()), std::string::npos);
  }
}

}  // namespace
}  // namespace sculpt::server
