#include "server/events/waits.hpp"

#include <chrono>

#include "server/base/current_error.hpp"
#include "server/events/job_view.hpp"

namespace sculpt::server {
namespace {

Json end_of(const JobRecord& job) {
  Json result{{"job", job.id}, {"state", name(job.state)}, {"timed_out", !is_final(job.state)}};
  if (!job.error_code.empty()) result["error"] = error_view(job);
  return result;
}

}  // namespace

void Waits::add(Call call, const std::string& job, double timeout_s) {
  const std::chrono::duration<double> timeout(timeout_s);
  auto timer =
      std::make_shared<net::steady_timer>(io_, std::chrono::duration_cast<net::steady_timer::duration>(timeout));
  waits_.emplace(job, Wait{std::move(call), timer});
  timer->async_wait([this, job, timer](const boost::system::error_code& error) {
    if (!error) on_timeout(job, timer);
  });
  look(job);
}

void Waits::on_changed(const std::string& job) {
  if (waits_.contains(job)) look(job);
}

void Waits::look(const std::string& job) {
  reads_.add([this, job](const std::stop_token&) {
    std::optional<JobRecord> record;
    Json error;
    try {
      record = find_job(store_, job);
    } catch (...) {
      error = current_error();
    }
    net::post(io_, [this, job, record = std::move(record), error = std::move(error)] { tell(job, record, error); });
  });
}

void Waits::tell(const std::string& job, const std::optional<JobRecord>& record, const Json& error) {
  auto [entry, end] = waits_.equal_range(job);
  while (entry != end) {
    if (record && !is_final(record->state) && !entry->second.over) {
      ++entry;
      continue;
    }
    const Wait wait = std::move(entry->second);
    entry = waits_.erase(entry);
    wait.timer->cancel();
    record ? answer(wait.call, end_of(*record)) : wait.call.session->refuse(wait.call.id, error);
  }
}

void Waits::on_timeout(const std::string& job, const std::shared_ptr<net::steady_timer>& timer) {
  auto [entry, end] = waits_.equal_range(job);
  while (entry != end && entry->second.timer != timer) ++entry;
  if (entry == end) return;
  entry->second.over = true;
  look(job);
}

void Waits::drop(Session& session) {
  for (auto entry = waits_.begin(); entry != waits_.end();) {
    if (entry->second.call.session.get() == &session) {
      entry->second.timer->cancel();
      entry = waits_.erase(entry);
    } else {
      ++entry;
    }
  }
}

}  // namespace sculpt::server
