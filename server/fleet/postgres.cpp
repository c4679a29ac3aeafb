// The one file that knows libpq (tests/fences.sh): connections, questions and what goes wrong with them, above 300
// lines.
#include "server/fleet/postgres.hpp"

#include <libpq-fe.h>
#include <poll.h>
#include <utf8.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "server/base/storage_error.hpp"

namespace sculpt::server {
namespace {

constexpr std::chrono::milliseconds retry_time{500}, look_time{200};

// The server gives up before we do, so that nothing is left there of what we no longer wait for. Plans are kept as long
// as the connection: a table that was small when one was made may be full of dead rows later, so all go by an index.
std::string session_settings(std::chrono::milliseconds patience) {
  const std::string ms = std::to_string(patience.count() * 4 / 5);
  return "SET client_min_messages=warning; SET timezone='UTC'; SET synchronous_commit=on; SET statement_timeout=" + ms +
         "; SET lock_timeout=" + ms +
         "; SET enable_seqscan=off; SET jit=off; SET idle_in_transaction_session_timeout=5000";
}

// Of SQLSTATE: a later try may help. The server stops or is full, it only reads (a standby), time was over, a deadlock.
bool may_pass(std::string_view state) {
  constexpr std::array classes{"08", "57", "53", "40"};
  constexpr std::array states{"25006", "25P03", "25P04", "55P03"};
  return std::ranges::any_of(classes, [&](const char* start) { return state.starts_with(start); }) ||
         std::ranges::find(states, state) != states.end();
}

std::string first_line(const char* message) {
  const std::string text = message == nullptr ? "" : message;
  const std::size_t end = text.find('\n');
  return text.empty() ? "it says nothing" : text.substr(0, end);
}

std::string read_password(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line))
    throw StorageError("cannot read the password of the database from '" + file.string() +
                       "': write it into the first line, or name another file with store_password_file");
  return line;
}

bool is_fine(const pg_result* result) {
  const ExecStatusType status = PQresultStatus(result);
  return status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK || status == PGRES_PIPELINE_SYNC;
}

std::string statement_name(const std::string& sql) {
  return std::to_string(std::hash<std::string>{}(sql));
}

std::string message_of(const pg_result* result) {
  return first_line(PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY));
}

}  // namespace

SqlValue sql_value(std::int64_t number) {
  return std::to_string(number);
}

SqlValue sql_value(const std::string& text) {
  std::string clean;
  utf8::replace_invalid(text.begin(), text.end(), std::back_inserter(clean));
  std::ranges::replace(clean, '\0', ' ');
  return clean;
}

SqlValue sql_flag(bool flag) {
  return std::string(flag ? "t" : "f");
}

Answered::Answered(pg_result* result) : result_(result, PQclear) {}

int Answered::rows() const {
  return PQntuples(result_.get());
}

std::string Answered::text(int row, int column) const {
  return {PQgetvalue(result_.get(), row, column), static_cast<std::size_t>(PQgetlength(result_.get(), row, column))};
}

std::int64_t Answered::number(int row, int column) const {
  const std::string digits = text(row, column);
  return digits.empty() ? 0 : std::stoll(digits);
}

bool Answered::flag(int row, int column) const {
  return text(row, column) == "t";
}

bool Answered::is(std::string_view command) const {
  return std::string_view(PQcmdStatus(result_.get())).starts_with(command);
}

std::int64_t Answered::changed() const {
  const std::string digits = PQcmdTuples(result_.get());
  return digits.empty() ? 0 : std::stoll(digits);
}

Postgres::Postgres(PostgresSource source, std::chrono::milliseconds patience)
    : source_(std::move(source)), patience_(patience) {}

Postgres::~Postgres() {
  drop();
}

void Postgres::drop() {
  PQfinish(connection_);
  connection_ = nullptr;
  prepared_.clear();
}

void Postgres::lose(const std::string& why) {
  drop();
  throw DatabaseUnavailable("the database does not answer (" + why + "): it is tried again until it does");
}

void Postgres::connect() {
  if (connection_ != nullptr && PQstatus(connection_) == CONNECTION_OK) return;
  drop();
  if (Clock::now() < next_try_) lose(last_fault_);
  const std::string password = source_.password_file.empty() ? "" : read_password(source_.password_file);
  // What stands before dbname gives way to the address, what stands behind it does not.
  const std::array keys{"connect_timeout",
                        "keepalives_idle",
                        "keepalives_interval",
                        "keepalives_count",
                        "tcp_user_timeout",
                        "application_name",
                        "target_session_attrs",
                        "dbname",
                        password.empty() ? nullptr : "password",
                        static_cast<const char*>(nullptr)};
  const std::array values{"5",
                          "30",
                          "5",
                          "3",
                          "10000",
                          "sculptd",
                          "read-write",
                          source_.url.c_str(),
                          password.c_str(),
                          static_cast<const char*>(nullptr)};
  made_ = Clock::now().time_since_epoch().count();
  connection_ = PQconnectdbParams(keys.data(), values.data(), 1);
  ++generation_;
  if (PQstatus(connection_) != CONNECTION_OK) {
    last_fault_ = first_line(PQerrorMessage(connection_));
    next_try_ = Clock::now() + retry_time;
    lose(last_fault_);
  }
  run(session_settings(patience_));
  if (std::exchange(went_silent_, false)) *source_.renewed = std::max(source_.renewed->load(), made_);
}

bool Postgres::is_distrusted() const {
  return connected() && made_ < *source_.renewed;
}

void Postgres::fail(const pg_result* result) {
  const char* field = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const std::string state = field == nullptr ? "" : field;
  const std::string what = message_of(result);
  if (PQstatus(connection_) != CONNECTION_OK || state.empty() || state.starts_with("57P")) lose(what);
  if (state == "53100") throw StorageFull("the database has no space (" + what + "): make room, then try again");
  if (state == "42501")
    throw StorageError("the role of this daemon may not do that in the database (" + what +
                       "): let the owner of the tables run 'sculptd migrate --daemon-role ROLE'");
  if (may_pass(state)) throw DatabaseUnavailable("the database cannot do it now (" + what + "): try again");
  throw StorageError("the database failed (" + state + "): " + what);
}

void Postgres::await_result(Clock::time_point end) {
  while (PQisBusy(connection_) != 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (is_distrusted()) lose("no answer, and another connection had to be made anew too");
    if (left.count() <= 0) {
      went_silent_ = true;
      lose("no answer for " + std::to_string(patience_.count()) + " ms");
    }
    pollfd waiting{PQsocket(connection_), POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::min(left, look_time).count()));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    if (PQconsumeInput(connection_) == 0) lose(first_line(PQerrorMessage(connection_)));
  }
}

// What is left of it is void: it is read up to its end.
void Postgres::leave_pipeline(Clock::time_point end) {
  for (int nulls = 0; PQstatus(connection_) == CONNECTION_OK;) {
    await_result(end);
    pg_result* more = PQgetResult(connection_);
    const bool last = more != nullptr && PQresultStatus(more) == PGRES_PIPELINE_SYNC;
    nulls = more == nullptr ? nulls + 1 : 0;
    PQclear(more);
    if (last || nulls > 1) break;
  }
  PQexitPipelineMode(connection_);
}

// Of the statement that is next; behind it stands a null.
Answered Postgres::next_result(Clock::time_point end) {
  await_result(end);
  pg_result* result = PQgetResult(connection_);
  if (result == nullptr) lose("an answer is missing");
  Answered answer(result);
  if (!is_fine(result)) {
    if (PQpipelineStatus(connection_) == PQ_PIPELINE_OFF) {
      while (pg_result* more = PQgetResult(connection_)) PQclear(more);
    } else {
      leave_pipeline(end);
    }
    fail(result);
  }
  return answer;
}

void Postgres::run(const std::string& statements) {
  if (connection_ == nullptr) connect();
  if (PQsendQuery(connection_, statements.c_str()) == 0) lose(first_line(PQerrorMessage(connection_)));
  const auto end = Clock::now() + patience_;
  for (await_result(end); pg_result* result = PQgetResult(connection_); await_result(end)) {
    const Answered answer(result);
    if (is_fine(result)) continue;
    while (pg_result* more = PQgetResult(connection_)) PQclear(more);
    fail(result);
  }
}

void Postgres::prepare(const std::string& sql) {
  if (prepared_.contains(sql)) return;
  const std::string name = statement_name(sql);
  if (PQsendPrepare(connection_, name.c_str(), sql.c_str(), 0, nullptr) == 0)
    lose(first_line(PQerrorMessage(connection_)));
  const auto end = Clock::now() + patience_;
  next_result(end);
  await_result(end);
  PQclear(PQgetResult(connection_));
  prepared_.insert(sql);
}

Answered Postgres::ask(const Question& question) {
  return ask_all({question}).front();
}

void Postgres::send(const Question& question) {
  std::vector<const char*> values;
  for (const SqlValue& value : question.values) values.push_back(value ? value->c_str() : nullptr);
  std::vector<int> lengths(values.size(), 0), formats(values.size(), 0);  // of text: nobody asks, and 0
  if (question.bytes) {
    values.push_back(question.bytes->data());
    lengths.push_back(static_cast<int>(question.bytes->size()));
    formats.push_back(1);
  }
  const std::string name = statement_name(question.sql);
  if (PQsendQueryPrepared(connection_, name.c_str(), static_cast<int>(values.size()), values.data(), lengths.data(),
                          formats.data(), question.raw ? 1 : 0) == 0)
    lose(first_line(PQerrorMessage(connection_)));
}

std::vector<Answered> Postgres::ask_all(const std::vector<Question>& questions) {
  connect();
  for (const Question& question : questions) prepare(question.sql);
  if (PQenterPipelineMode(connection_) == 0) lose("it cannot take several questions");
  for (const Question& question : questions) send(question);
  if (PQpipelineSync(connection_) == 0) lose(first_line(PQerrorMessage(connection_)));
  const auto end = Clock::now() + patience_;
  std::vector<Answered> answers;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    answers.push_back(next_result(end));
    await_result(end);
    PQclear(PQgetResult(connection_));  // the null behind it
  }
  next_result(end);  // the end of the pipeline
  if (PQexitPipelineMode(connection_) == 0) lose(first_line(PQerrorMessage(connection_)));
  return answers;
}

std::vector<Answered> Postgres::ask_again(const std::vector<Question>& questions) {
  if (is_distrusted()) drop();
  const bool old = connected();
  try {
    return ask_all(questions);
  } catch (const DatabaseUnavailable&) {
    if (!old || connected()) throw;
  }
  return ask_all(questions);
}

bool Postgres::await_notice(std::chrono::milliseconds patience) {
  connect();
  const auto noticed = [this] {
    bool any = false;
    while (PGnotify* notice = PQnotifies(connection_)) {
      PQfreemem(notice);
      any = true;
    }
    return any;
  };
  if (noticed()) return true;
  pollfd waiting{PQsocket(connection_), POLLIN, 0};
  if (::poll(&waiting, 1, static_cast<int>(patience.count())) <= 0) return false;
  if (PQconsumeInput(connection_) == 0) lose(first_line(PQerrorMessage(connection_)));
  return noticed();
}

}  // namespace sculpt::server
