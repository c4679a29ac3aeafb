// A config file; and its text as each single setting, as a flag or a variable gives it.
#include "proto/error_codes.hpp"
#include "proto/json.hpp"
#include "server/base/settings.hpp"
#include "tests/fuzz/target.hpp"

namespace {

using namespace sculpt::server;
namespace proto = sculpt::proto;

void read_file(std::string_view bytes) {
  Config config;
  try {
    read_settings(proto::parse_json(bytes), "/etc/sculptd", config);
  } catch (const proto::JsonError&) {
    return;
  } catch (const proto::ProtocolError&) {
    return;
  } catch (const ConfigError&) {
    return;
  }
  for (const Setting& setting : settings()) proto::write_json(setting.show(config));
}

}  // namespace

void read_hostile(std::string_view bytes) {
  read_file(bytes);
  for (const Setting& setting : settings()) {
    Config config;
    try {
      read_setting(setting, std::string(bytes), config);
    } catch (const ConfigError&) {
    }
  }
}
