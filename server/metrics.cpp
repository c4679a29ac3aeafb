#include "server/metrics.hpp"

#include "server/services.hpp"

namespace sculpt {

std::string metrics_text(const Services& services) {
  std::string text =
      "# HELP sculptd_jobs Jobs in each state.\n"
      "# TYPE sculptd_jobs gauge\n";
  for (const auto& [state, jobs] : services.store.counts()) {
    text += std::string("sculptd_jobs{state=\"") + name(state) + "\"} " + std::to_string(jobs) + "\n";
  }
  text +=
      "# HELP sculptd_connections Open connections.\n"
      "# TYPE sculptd_connections gauge\n"
      "sculptd_connections " +
      std::to_string(services.connections.count()) + "\n";
  return text;
}

}  // namespace sculpt
