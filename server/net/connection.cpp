#include "server/net/connection.hpp"

#include <vector>

namespace sculpt::server {

void Connections::for_each(const std::function<void(Connection&)>& visit) {
  for (auto entry = list_.begin(); entry != list_.end();) {
    const std::shared_ptr<Connection> connection = entry->lock();
    if (connection) visit(*connection);
    entry = connection ? std::next(entry) : list_.erase(entry);
  }
}

std::size_t Connections::count() {
  std::size_t found = 0;
  for_each([&](const Connection& connection) { found += connection.spare() ? 0 : 1; });
  return found;
}

std::size_t Connections::count_of(const std::string& owner) {
  std::size_t found = 0;
  for_each([&](const Connection& connection) {
    const Identity* identity = connection.identity();
    if (identity != nullptr && identity->owner == owner) ++found;
  });
  return found;
}

void Connections::thin_spare(std::size_t most) {
  std::vector<std::shared_ptr<Connection>> spare;
  for (const std::weak_ptr<Connection>& entry : list_) {
    const std::shared_ptr<Connection> connection = entry.lock();
    if (connection && connection->spare()) spare.push_back(connection);
  }
  for (std::size_t i = 0; i + most < spare.size(); ++i) spare[i]->close("the server is full");
}

}  // namespace sculpt::server
