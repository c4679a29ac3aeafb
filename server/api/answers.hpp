// Calls that leave the I/O thread for some work and come back with what the work gave.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <type_traits>
#include <utility>

#include "server/base/current_error.hpp"
#include "server/base/task_queue.hpp"
#include "server/net/net.hpp"
#include "server/net/session.hpp"

namespace sculpt::server {

/// The way back to the I/O thread. Lives as long as the queues.
class Answers {
 public:
  /// `reads`: the thread of questions to the store.
  Answers(net::io_context& io, TaskQueue& reads) : io_(io), reads_(reads) {}

  /// Answers with what `work` returns or throws. Any thread but the I/O thread.
  void with(std::shared_ptr<Call> call, const std::function<Answer()>& work) const;
  /// Does `work` on the queue's thread and answers with what it returns or throws.
  void from(TaskQueue& queue, Call call, std::function<Answer(std::stop_token)> work) const;
  /// Asks the store. What the connection sends behind this call waits for the answer.
  void read(Call call, std::function<Json()> work) const;

  /// Does `work(stop_token)` on the queue's thread; then, on the I/O thread, `next(Call, what it gave)` answers. What
  /// either throws is the answer.
  template <class Work, class Next>
  void detour(TaskQueue& queue, Call call, Work work, Next next) const;
  /// The same for a question to the store, `work()`. What the connection sends behind it waits for the answer.
  template <class Work, class Next>
  void read_then(Call call, Work work, Next next) const;

 private:
  template <class Work, class Next>
  void return_with(std::shared_ptr<Call> call, Work work, Next next) const;

  net::io_context& io_;
  TaskQueue& reads_;
};

template <class Work, class Next>
void Answers::return_with(std::shared_ptr<Call> call, Work work, Next next) const {
  std::optional<std::invoke_result_t<Work&>> result;
  Json error;
  try {
    result.emplace(work());
  } catch (...) {
    error = current_error();
  }
  // Moved, so that the last owner of a session is always the I/O thread.
  net::post(io_, [call = std::move(call), result = std::move(result), error = std::move(error),
                  next = std::move(next)]() mutable {
    if (!result) return call->session->refuse(call->id, error);
    const std::shared_ptr<Session> session = call->session;
    const Json id = call->id;
    try {
      next(std::move(*call), std::move(*result));
    } catch (...) {
      session->refuse(id, current_error());
    }
  });
}

template <class Work, class Next>
void Answers::detour(TaskQueue& queue, Call call, Work work, Next next) const {
  auto waiting = std::make_shared<Call>(std::move(call));
  queue.add([this, waiting = std::move(waiting), work = std::move(work), next](const std::stop_token& stop) mutable {
    return_with(
        std::move(waiting), [&] { return work(stop); }, next);
  });
}

template <class Work, class Next>
void Answers::read_then(Call call, Work work, Next next) const {
  call.session->hold();
  detour(
      reads_, std::move(call), [work = std::move(work)](const std::stop_token&) { return work(); }, next);
}

}  // namespace sculpt::server
