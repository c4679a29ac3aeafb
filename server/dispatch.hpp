// Method names -> handlers, and exceptions -> error replies: the one place on the I/O side where errors are caught.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "proto/json.hpp"

namespace sculpt {

class Session;
class TaskQueue;
struct Answer;
struct Services;

/// A request on its way to its answer.
struct Call {
  std::shared_ptr<Session> session;
  Json id;
  Json params;
  std::string chunk;
};

/// Runs on the I/O thread and must not block. Answers the call, now or later, or throws.
using Handler = void (*)(Services&, Call);

void dispatch(Services& services, Call call, const std::string& method);

/// All methods, in the order of PROTOCOL.md.
std::vector<std::string_view> method_names();

/// Call inside a catch block: the exception as the `error` object of a reply.
Json current_error();

/// Answers at once.
void answer(const Call& call, Json result);

/// Answers with what `work` returns or throws. Any thread but the I/O thread.
void answer_with(Services& services, std::shared_ptr<Call> call, const std::function<Answer()>& work);

/// Does `work` on the queue's thread and answers with what it returns or throws.
void answer_from(TaskQueue& queue, Services& services, Call call, std::function<Answer(std::stop_token)> work);

/// Asks the store, on the thread of reads. What the connection sends behind this call waits for the answer.
void answer_read(Services& services, Call call, std::function<Json()> work);

}  // namespace sculpt
