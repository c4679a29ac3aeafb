#include "server/connection.hpp"

namespace sculpt {

void Connections::for_each(const std::function<void(Connection&)>& visit) {
  for (auto entry = list_.begin(); entry != list_.end();) {
    const std::shared_ptr<Connection> connection = entry->lock();
    if (connection) visit(*connection);
    entry = connection ? std::next(entry) : list_.erase(entry);
  }
}

std::size_t Connections::count() {
  std::size_t found = 0;
  for_each([&](const Connection&) { ++found; });
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

}  // namespace sculpt
