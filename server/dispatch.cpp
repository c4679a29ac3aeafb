#include "server/dispatch.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <new>
#include <string_view>

#include "server/detour.hpp"
#include "server/handlers.hpp"
#include "server/services.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

struct Entry {
  std::string_view method;
  Handler handler;
  Scope scope = Scope::admin;
};

constexpr std::array table{
    Entry{"hello", on_hello, Scope::read},
    Entry{"ping", on_ping, Scope::read},
    Entry{"server.info", on_server_info, Scope::read},
    Entry{"server.schema", on_server_schema, Scope::read},
    Entry{"blob.has", on_blob_has, Scope::submit},
    Entry{"blob.put", on_blob_put, Scope::submit},
    Entry{"job.submit", on_submit, Scope::submit},
    Entry{"job.get", on_get, Scope::read},
    Entry{"job.list", on_list, Scope::read},
    Entry{"job.cancel", on_cancel, Scope::submit},
    Entry{"job.pause", on_pause, Scope::submit},
    Entry{"job.resume", on_resume, Scope::submit},
    Entry{"job.retry", on_retry, Scope::submit},
    Entry{"job.wait", on_wait, Scope::read},
    Entry{"job.report", on_report, Scope::read},
    Entry{"job.verify", on_verify, Scope::submit},
    Entry{"queue.pause", on_queue_pause, Scope::admin},
    Entry{"queue.resume", on_queue_resume, Scope::admin},
    Entry{"events.subscribe", on_subscribe, Scope::read},
    Entry{"events.unsubscribe", on_unsubscribe, Scope::read},
    Entry{"artifact.list", on_artifact_list, Scope::read},
    Entry{"artifact.read", on_artifact_read, Scope::read},
    Entry{"artifact.pin", on_artifact_pin, Scope::submit},
};

const Entry& find_entry(const std::string& method) {
  const auto* found = std::ranges::find(table, method, &Entry::method);
  if (found != table.end()) return *found;
  std::string names;
  for (const std::string_view name : method_names()) names += (names.empty() ? "" : ", ") + std::string(name);
  throw ProtocolError("unknown_method", "there is no method '" + method + "': there are " + names, "/method");
}

}  // namespace

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : table) names.push_back(entry.method);
  return names;
}

Json current_error() {
  try {
    throw;
  } catch (const ProtocolError& error) {
    return error_object(error.code(), error.what(), error.pointer());
  } catch (const InputError& error) {
    return error_object(error.code(), error.what());
  } catch (const Cancelled&) {
    return error_object("stopping", "the daemon is stopping: try again when it is back");
  } catch (const StorageFull& error) {
    return error_object("storage_full", error.what());
  } catch (const StorageError& error) {
    spdlog::error("{}", error.what());
    return error_object("storage_error", error.what());
  } catch (const std::bad_alloc&) {
    return error_object("out_of_memory", "the server has not enough memory for this: use a smaller resolution or mesh");
  } catch (const std::exception& error) {
    spdlog::error("internal error: {}", error.what());
    return error_object("internal_error", std::string("the server failed: ") + error.what());
  }
}

void dispatch(Services& services, Call call, const std::string& method) {
  const std::shared_ptr<Session> session = call.session;
  const Json id = call.id;
  try {
    const Entry& entry = find_entry(method);
    if (!session->identity() && entry.handler != on_hello) {
      throw ProtocolError(
          "hello_required",
          "say hello first: {\"id\":1,\"method\":\"hello\",\"params\":{\"protocol\":[1,0],\"client\":\"NAME\"}}");
    }
    if (session->identity()) require_scope(*session->identity(), entry.scope);
    entry.handler(services, std::move(call));
  } catch (...) {
    session->refuse(id, current_error());
  }
}

void answer(const Call& call, Json result) {
  call.session->answer(call.id, {reply_line(call.id, result), std::nullopt});
}

void answer_with(Services& services, std::shared_ptr<Call> call, const std::function<Answer()>& work) {
  const Json id = call->id;
  return_with(
      services, std::move(call),
      [&] {
        Answer answer = work();
        return Reply{reply_line(id, answer.result), std::move(answer.chunk)};
      },
      [](const Call& answered, Reply reply) { answered.session->answer(answered.id, std::move(reply)); });
}

void answer_from(TaskQueue& queue, Services& services, Call call, std::function<Answer(std::stop_token)> work) {
  auto waiting = std::make_shared<Call>(std::move(call));
  queue.add([&services, waiting = std::move(waiting), work = std::move(work)](const std::stop_token& stop) mutable {
    answer_with(services, std::move(waiting), [&] { return work(stop); });
  });
}

void answer_read(Services& services, Call call, std::function<Json()> work) {
  call.session->hold();
  answer_from(services.reads, services, std::move(call), [work = std::move(work)](const std::stop_token&) {
    return Answer{work(), std::nullopt};
  });
}

}  // namespace sculpt
