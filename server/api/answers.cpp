#include "server/api/answers.hpp"

#include "proto/request.hpp"

namespace sculpt::server {

void Answers::with(std::shared_ptr<Call> call, const std::function<Answer()>& work) const {
  const Json id = call->id;
  return_with(
      std::move(call),
      [&] {
        Answer answer = work();
        return Reply{proto::reply_line(id, answer.result), std::move(answer.chunk)};
      },
      [](const Call& answered, Reply reply) { answered.session->answer(answered.id, std::move(reply)); });
}

void Answers::from(TaskQueue& queue, Call call, std::function<Answer(std::stop_token)> work) const {
  auto waiting = std::make_shared<Call>(std::move(call));
  queue.add([this, waiting = std::move(waiting), work = std::move(work)](const std::stop_token& stop) mutable {
    with(std::move(waiting), [&] { return work(stop); });
  });
}

void Answers::read(Call call, std::function<Json()> work) const {
  call.session->hold();
  from(reads_, std::move(call), [work = std::move(work)](const std::stop_token&) {
    return Answer{work(), std::nullopt};
  });
}

}  // namespace sculpt::server
