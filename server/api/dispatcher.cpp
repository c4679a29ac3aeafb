#include "server/api/dispatcher.hpp"

#include <stdexcept>

#include "proto/error_codes.hpp"
#include "server/access/access.hpp"
#include "server/api/methods.hpp"
#include "server/base/current_error.hpp"
#include "server/net/session.hpp"

namespace sculpt::server {
namespace {

constexpr std::string_view hello = "hello";

}  // namespace

Dispatcher::Dispatcher(Handlers handlers, Streams& streams, Waits& waits)
    : handlers_(std::move(handlers)), streams_(streams), waits_(waits) {
  for (const Method& method : methods())
    if (!handlers_.contains(method.name)) throw std::logic_error("nobody handles " + std::string(method.name));
}

void Dispatcher::take(Call call, const std::string& method) {
  const std::shared_ptr<Session> session = call.session;
  const Json id = call.id;
  try {
    const auto& [name, scope] = find_method(method);
    if (!session->identity() && name != hello) {
      throw proto::ProtocolError(
          "hello_required",
          "say hello first: {\"id\":1,\"method\":\"hello\",\"params\":{\"protocol\":[1,0],\"client\":\"NAME\"}}");
    }
    if (session->identity()) require_scope(*session->identity(), scope);
    handlers_.at(name)(std::move(call));
  } catch (...) {
    session->refuse(id, current_error());
  }
}

void Dispatcher::on_closed(Session& session) {
  streams_.drop(session);
  waits_.drop(session);
}

}  // namespace sculpt::server
