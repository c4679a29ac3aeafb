// A call that leaves the I/O thread for some work and comes back with what the work gave.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <type_traits>
#include <utility>

#include "server/dispatch.hpp"
#include "server/net.hpp"
#include "server/services.hpp"
#include "server/session.hpp"

namespace sculpt {

/// Does `work` here, on any thread but the I/O thread; then, on that, `next(Call, what it gave)` answers. What either
/// throws is the answer.
template <class Work, class Next>
void return_with(Services& services, std::shared_ptr<Call> call, Work work, Next next) {
  std::optional<std::invoke_result_t<Work&>> result;
  Json error;
  try {
    result.emplace(work());
  } catch (...) {
    error = current_error();
  }
  // Moved, so that the last owner of a session is always the I/O thread.
  net::post(services.io, [call = std::move(call), result = std::move(result), error = std::move(error),
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

/// Does `work(stop_token)` on the queue's thread, and goes on as return_with does.
template <class Work, class Next>
void detour(TaskQueue& queue, Services& services, Call call, Work work, Next next) {
  auto waiting = std::make_shared<Call>(std::move(call));
  queue.add(
      [&services, waiting = std::move(waiting), work = std::move(work), next](const std::stop_token& stop) mutable {
        return_with(
            services, std::move(waiting), [&] { return work(stop); }, next);
      });
}

/// The same for a question to the store. What the connection sends behind it waits for the answer.
template <class Work, class Next>
void read_then(Services& services, Call call, Work work, Next next) {
  call.session->hold();
  detour(
      services.reads, services, std::move(call), [work = std::move(work)](const std::stop_token&) { return work(); },
      next);
}

}  // namespace sculpt
