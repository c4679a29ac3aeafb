#include "server/run/child_question.hpp"

#include <cstdio>
#include <iostream>
#include <new>

#include "server/run/child_process.hpp"

namespace sculpt::server {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds look_every{50};
constexpr std::size_t max_answer = 16u << 20;

std::optional<Json> read_object(const std::string& heard) try {
  Json said = proto::parse_json(heard);
  return said.is_object() ? std::optional(std::move(said)) : std::nullopt;
} catch (const proto::JsonError&) {
  return std::nullopt;
}

Json report(const char* code, const std::string& sentence) {
  return {{"code", code}, {"sentence", sentence}};
}

}  // namespace

ChildAnswer ask_child(const StoredSpec& stored, const Isolation& isolation, const char* option,
                      std::optional<std::chrono::milliseconds> patience, const std::stop_token& stop) {
  const auto start = Clock::now();
  ChildProcess child(isolation.worker, option);
  child.send(describe(stored, isolation));
  std::string heard;
  while (heard.size() <= max_answer) {
    if (stop.stop_requested()) throw Cancelled{};
    if (patience && Clock::now() - start > *patience) return {std::nullopt, {}, true};
    const std::optional<std::string> bytes = child.read(look_every);
    if (!bytes) continue;
    if (bytes->empty()) return {read_object(heard), child.wait()};
    heard += *bytes;
  }
  return {};
}

void ask_about_result(StoredSpec stored, const Isolation& isolation, const ResultQuestion& question,
                      const std::stop_token& stop) {
  stored.time_s = std::chrono::ceil<std::chrono::seconds>(isolation.result_time).count();
  const ChildAnswer answer = ask_child(stored, isolation, question.option, isolation.result_time, stop);
  const std::string who = std::string("the process that ") + question.deed;
  if (answer.too_late)
    throw InputError("run_time_exceeded", who + " did not end within " + std::to_string(stored.time_s) +
                                              " s (result_s): ask for a smaller plan, or let the server wait longer");
  if (!answer.said) throw std::runtime_error(who + " ended with " + (answer.end.empty() ? "no word" : answer.end));
  rethrow_reported(*answer.said);
}

int answer_parent(FolderUse use, const std::function<Json(const DescribedJob&, const Job&)>& find) {
  return answer_parent(
      [&](const DescribedJob& described) { return find(described, load_and_confine(described, use)); });
}

int answer_parent(const std::function<Json(const DescribedJob&)>& find) {
  std::FILE* out = take_output();
  const std::optional<DescribedJob> described = take_description(std::cin);
  if (!described) return EXIT_FAILURE;
  Json said;
  try {
    said = find(*described);
  } catch (const InputError& error) {
    said = report(error.code().c_str(), error.what());
  } catch (const proto::ProtocolError& error) {
    said = report(error.code().c_str(), error.what());
  } catch (const std::bad_alloc&) {
    said = report("out_of_memory", "there is not enough memory to read the mesh: use a smaller one");
  }
  std::fputs(proto::write_json(said).c_str(), out);
  std::fclose(out);
  return EXIT_SUCCESS;
}

void rethrow_reported(const Json& said) {
  if (said.contains("code")) throw InputError(said.at("code"), said.at("sentence").get<std::string>());
}

}  // namespace sculpt::server
