// Calls of job.wait that are not answered yet. I/O thread only.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "server/base/task_queue.hpp"
#include "server/net/net.hpp"
#include "server/net/session.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

class Waits {
 public:
  Waits(net::io_context& io, JobStore& store, TaskQueue& reads) : io_(io), store_(store), reads_(reads) {}

  /// Answers the call when the job is in a final state, or after `timeout_s`; refuses it when there is no such job.
  void add(Call call, const std::string& job, double timeout_s);
  void on_changed(const std::string& job);
  /// The session is gone: its calls are not answered any more.
  void drop(Session& session);

 private:
  struct Wait {
    Call call;
    std::shared_ptr<net::steady_timer> timer;
    bool over = false;  // its time is
  };
  void look(const std::string& job);
  /// Ends the waits that can be: all when the job was not found (`error`) or has ended, else those whose time is over.
  void tell(const std::string& job, const std::optional<JobRecord>& record, const Json& error);
  void on_timeout(const std::string& job, const std::shared_ptr<net::steady_timer>& timer);

  net::io_context& io_;
  JobStore& store_;
  TaskQueue& reads_;
  std::multimap<std::string, Wait> waits_;
};

}  // namespace sculpt::server
