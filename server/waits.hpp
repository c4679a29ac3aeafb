// Calls of job.wait that are not answered yet. I/O thread only.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "server/dispatch.hpp"
#include "server/job_store.hpp"
#include "server/net.hpp"

namespace sculpt {

class Waits {
 public:
  Waits(net::io_context& io, JobStore& store) : io_(io), store_(store) {}

  /// Answers the call when the job is in a final state, or after `timeout_s`.
  void add(Call call, const std::string& job, double timeout_s);
  void on_changed(const std::string& job);
  /// The session is gone: its calls are not answered any more.
  void drop(Session& session);

 private:
  struct Wait {
    Call call;
    std::shared_ptr<net::steady_timer> timer;
  };
  void on_timeout(const std::string& job, const std::shared_ptr<net::steady_timer>& timer);

  net::io_context& io_;
  JobStore& store_;
  std::multimap<std::string, Wait> waits_;
};

}  // namespace sculpt
