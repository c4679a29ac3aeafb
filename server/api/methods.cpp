#include "server/api/methods.hpp"

#include <algorithm>
#include <array>

#include "proto/error_codes.hpp"

namespace sculpt::server {
namespace {

constexpr std::array table{
    Method{"hello", Scope::read},
    Method{"ping", Scope::read},
    Method{"server.info", Scope::read},
    Method{"server.schema", Scope::read},
    Method{"blob.has", Scope::submit},
    Method{"blob.put", Scope::submit},
    Method{"cell.check", Scope::submit},
    Method{"job.submit", Scope::submit},
    Method{"job.get", Scope::read},
    Method{"job.list", Scope::read},
    Method{"job.cancel", Scope::submit},
    Method{"job.pause", Scope::submit},
    Method{"job.resume", Scope::submit},
    Method{"job.retry", Scope::submit},
    Method{"job.wait", Scope::read},
    Method{"job.report", Scope::read},
    Method{"job.verify", Scope::submit},
    Method{"job.samples", Scope::read},
    Method{"job.cell", Scope::read},
    Method{"queue.pause", Scope::admin},
    Method{"queue.resume", Scope::admin},
    Method{"events.subscribe", Scope::read},
    Method{"events.unsubscribe", Scope::read},
    Method{"artifact.list", Scope::read},
    Method{"artifact.read", Scope::read},
    Method{"artifact.link", Scope::read},
    Method{"artifact.pin", Scope::submit},
};

}  // namespace

std::span<const Method> methods() {
  return table;
}

const Method& find_method(const std::string& name) {
  const auto* found = std::ranges::find(table, name, &Method::name);
  if (found != table.end()) return *found;
  std::string names;
  for (const Method& method : table) names += (names.empty() ? "" : ", ") + std::string(method.name);
  throw proto::ProtocolError("unknown_method", "there is no method '" + name + "': there are " + names, "/method");
}

}  // namespace sculpt::server
