#include "clients/cpp/login.hpp"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace sculpt::client {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string first_line(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) {
    throw std::runtime_error("cannot read a token from the file '" + path + "' that SCULPT_TOKEN_FILE names");
  }
  return line;
}

}  // namespace

Login login_from_environment() {
  Login login{variable("SCULPT_TOKEN"), variable("SCULPT_TLS_CA"), variable("SCULPT_TLS_CERT"),
              variable("SCULPT_TLS_KEY")};
  const std::string file = variable("SCULPT_TOKEN_FILE");
  if (login.token.empty() && !file.empty()) login.token = first_line(file);
  return login;
}

}  // namespace sculpt::client
