// How a client proves who it is, and how it knows that the server is the right one.
#pragma once

#include <string>

namespace sculpt::client {

struct Login {
  std::string token;             ///< from the operator (sculptd token add); empty: none
  std::string ca;                ///< PEM file of the authorities that may vouch for the server; empty: the system's
  std::string certificate, key;  ///< PEM files of the client's own certificate; empty: none
};

/// SCULPT_TOKEN, else the first line of the file SCULPT_TOKEN_FILE; SCULPT_TLS_CA, SCULPT_TLS_CERT, SCULPT_TLS_KEY.
/// Throws std::runtime_error naming the file that cannot be read.
Login login_from_environment();

}  // namespace sculpt::client
