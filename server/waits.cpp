#include "server/waits.hpp"

#include <chrono>

#include "server/job_view.hpp"
#include "server/net.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

void answer(const Call& call, const JobRecord& job) {
  Json result{{"job", job.id}, {"state", name(job.state)}, {"timed_out", !is_final(job.state)}};
  if (!job.error_code.empty()) result["error"] = error_view(job);
  call.session->answer(call.id, {std::move(result), std::nullopt});
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
  on_changed(job);
}

void Waits::on_changed(const std::string& job) {
  auto [entry, end] = waits_.equal_range(job);
  if (entry == end) return;
  const std::optional<JobRecord> record = store_.find(job);
  if (!record || !is_final(record->state)) return;
  while (entry != end) {
    const Wait wait = entry->second;
    entry = waits_.erase(entry);
    wait.timer->cancel();
    answer(wait.call, *record);
  }
}

void Waits::on_timeout(const std::string& job, const std::shared_ptr<net::steady_timer>& timer) {
  auto [entry, end] = waits_.equal_range(job);
  while (entry != end && entry->second.timer != timer) ++entry;
  if (entry == end) return;
  const Wait wait = entry->second;
  waits_.erase(entry);
  if (const std::optional<JobRecord> record = store_.find(job)) answer(wait.call, *record);
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

}  // namespace sculpt
