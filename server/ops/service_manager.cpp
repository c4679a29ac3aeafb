#include "server/ops/service_manager.hpp"

#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace sculpt::server {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

std::optional<ServiceManager::Clock::duration> half_of_the_watchdogs_time() {
  const std::string pid = variable("WATCHDOG_PID"), us = variable("WATCHDOG_USEC");
  const bool for_us = pid.empty() || pid == std::to_string(::getpid());
  if (!for_us || us.empty() || us.size() > 18 || us.find_first_not_of("0123456789") != std::string::npos) return {};
  return std::chrono::microseconds(std::stoll(us)) / 2;
}

}  // namespace

ServiceManager::ServiceManager() {
  const std::string path = variable("NOTIFY_SOCKET");
  if (path.size() < 2 || path.size() >= sizeof address_.sun_path || (path[0] != '/' && path[0] != '@')) return;
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, path.data(), path.size());
  if (path[0] == '@') address_.sun_path[0] = '\0';  // the abstract name space
  address_bytes_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size());
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  beat_ = half_of_the_watchdogs_time();
}

ServiceManager::~ServiceManager() {
  if (socket_ >= 0) ::close(socket_);
}

void ServiceManager::reloading() {
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch());
  tell("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(us.count()));
}

void ServiceManager::status(const std::string& sentence) {
  if (sentence == status_) return;
  status_ = sentence;
  tell("STATUS=" + sentence);
}

void ServiceManager::alive(Clock::time_point now) {
  if (!beat_ || now - told_at_ < *beat_) return;
  told_at_ = now;
  tell("WATCHDOG=1");
}

// Never waits: a manager that takes nothing must not hang the daemon.
void ServiceManager::tell(const std::string& lines) {
  if (!listens()) return;
  ::sendto(socket_, lines.data(), lines.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
           reinterpret_cast<const sockaddr*>(&address_), address_bytes_);
}

std::string queue_sentence(JobStore& store) {
  const auto counts = store.counts();
  return std::to_string(counts.at(JobState::running)) + " running, " + std::to_string(counts.at(JobState::queued)) +
         " queued";
}

}  // namespace sculpt::server
