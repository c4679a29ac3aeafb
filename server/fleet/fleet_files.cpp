#include "server/fleet/fleet_files.hpp"

#include <fstream>

#include "server/base/job_id.hpp"
#include "server/base/storage_error.hpp"
#include "server/base/time_stamp.hpp"

namespace sculpt::server {
namespace {

// A piece is a megabyte, and the disk of the database may be slow.
constexpr std::chrono::seconds file_patience{30};

constexpr const char* size_of = "SELECT size FROM sculptd.file WHERE path=$1";
// From the piece in which the offset lies: of each its part.
constexpr const char* read_pieces =
    "SELECT substring(bytes FROM (greatest($2::bigint - at, 0) + 1)::integer FOR "
    "($2::bigint + $3::bigint - greatest($2::bigint, at))::integer) FROM sculptd.piece JOIN sculptd.file ON file = "
    "number WHERE path=$1 AND at < $2::bigint + $3::bigint AND at >= coalesce((SELECT max(first.at) FROM sculptd.piece "
    "AS first WHERE first.file = number AND first.at <= $2::bigint), 0) ORDER BY at";
constexpr const char* all_of_job =
    "SELECT path, size FROM sculptd.file WHERE job = (SELECT number FROM sculptd.job WHERE id=$1)";
constexpr const char* all_by_job =
    "SELECT id, sum(size)::bigint FROM sculptd.file JOIN sculptd.job ON file.job = job.number GROUP BY id";
// Only by the run that has the job.
constexpr const char* make_of_job =
    "INSERT INTO sculptd.file(path, job) SELECT $1, number FROM sculptd.job WHERE id=$2 AND attempt=$3 AND state IN "
    "('running', 'pausing', 'cancelling') ON CONFLICT(path) DO NOTHING";
constexpr const char* make_of_none = "INSERT INTO sculptd.file(path) VALUES($1)";
constexpr const char* append_piece =
    "WITH grown AS (UPDATE sculptd.file SET size = size + length($3::bytea) WHERE path=$1 AND size=$2 RETURNING "
    "number) "
    "INSERT INTO sculptd.piece SELECT number, $2, $3 FROM grown";
constexpr const char* replace_all =
    "WITH written AS (UPDATE sculptd.file SET size = length($2::bytea) WHERE path=$1 RETURNING number) INSERT INTO "
    "sculptd.piece SELECT number, 0, $2 FROM written ON CONFLICT(file, at) DO UPDATE SET bytes=excluded.bytes";
// The first that comes gives it its name.
constexpr const char* name_upload =
    "UPDATE sculptd.file SET path=$2 WHERE path=$1 AND NOT EXISTS(SELECT 1 FROM sculptd.file WHERE path=$2)";
constexpr const char* use_file =
    "WITH used AS (UPDATE sculptd.file SET used=now() WHERE path=$1 AND used < now() - interval '10 minutes') "
    "SELECT size FROM sculptd.file WHERE path=$1";
// A few at a time: large ones take a while.
constexpr const char* remove_some =
    "DELETE FROM sculptd.file WHERE number IN (SELECT number FROM sculptd.file WHERE job IS NULL AND (path LIKE "
    "'jobs/%' OR (used < now() - $1 * interval '1 s' AND NOT path = ANY($2::text[]))) LIMIT 20)";

// As PostgreSQL writes an array; of names that need no quotes.
SqlValue array_of(const std::set<std::string>& names) {
  std::string array;
  for (const std::string& name : names) array += (array.empty() ? "" : ",") + name;
  return "{" + array + "}";
}

SqlValue number(std::uint64_t value) {
  return sql_value(static_cast<std::int64_t>(value));
}

std::optional<std::uint64_t> first_size(const Answered& answer) {
  return answer.rows() == 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(answer.number(0, 0)));
}

}  // namespace

Answered FleetFiles::Connection::ask(const Question& question) {
  return ask_all({question}).front();
}

std::vector<Answered> FleetFiles::Connection::ask_all(const std::vector<Question>& questions) {
  const std::lock_guard lock(mutex);
  return database.ask_again(questions);
}

FleetFiles::FleetFiles(const PostgresSource& source)
    : reading_{{}, {source, file_patience}}, writing_{{}, {source, file_patience}} {}

std::optional<std::uint64_t> FleetFiles::size(const std::string& path) {
  return first_size(reading_.ask({size_of, {sql_value(path)}}));
}

std::string FleetFiles::read(const std::string& path, std::uint64_t offset, std::uint64_t bytes) {
  Question question{read_pieces, {sql_value(path), number(offset), number(std::min(bytes, shared_piece_bytes))}};
  question.raw = true;
  const Answered answer = reading_.ask(question);
  std::string all;
  for (int row = 0; row < answer.rows(); ++row) all += answer.text(row, 0);
  return all;
}

std::map<std::string, std::uint64_t> FleetFiles::sizes(const Question& question) {
  const Answered answer = reading_.ask(question);
  std::map<std::string, std::uint64_t> sizes;
  for (int row = 0; row < answer.rows(); ++row)
    sizes[answer.text(row, 0)] = static_cast<std::uint64_t>(answer.number(row, 1));
  return sizes;
}

std::map<std::string, std::uint64_t> FleetFiles::files_of(const std::string& job) {
  return sizes({all_of_job, {sql_value(job)}});
}

std::map<std::string, std::uint64_t> FleetFiles::bytes_of_jobs() {
  return sizes({all_by_job});
}

bool FleetFiles::make(const std::string& job, int attempt, const std::string& path) {
  const auto answers = writing_.ask_all(
      {{make_of_job, {sql_value(path), sql_value(job), sql_value(attempt)}}, {size_of, {sql_value(path)}}});
  return answers[1].rows() > 0;
}

void FleetFiles::append(const std::string& path, std::uint64_t offset, std::string_view bytes) {
  const std::lock_guard lock(writing_.mutex);
  // Not asked again where the connection breaks: it may have been done.
  if (writing_.database.ask({append_piece, {sql_value(path), number(offset)}, std::string(bytes)}).changed() != 1)
    throw StorageError("'" + path + "' of the fleet is gone, or does not end at byte " + std::to_string(offset));
}

void FleetFiles::replace(const std::string& path, std::string_view bytes) {
  if (writing_.ask({replace_all, {sql_value(path)}, std::string(bytes)}).changed() != 1)
    throw StorageError("'" + path + "' of the fleet is gone");
}

void FleetFiles::remove(const std::set<std::string>& paths) {
  if (!paths.empty()) writing_.ask({"DELETE FROM sculptd.file WHERE path = ANY($1::text[])", {array_of(paths)}});
}

void FleetFiles::upload(const std::filesystem::path& from, const std::string& path) {
  if (use(path)) return;
  const std::string draft = path + "." + IdMaker().next(unix_ms()) + ".part";
  std::ifstream in(from, std::ios::binary);
  if (!in) throw StorageError("cannot read '" + from.string() + "'");
  writing_.ask({make_of_none, {sql_value(draft)}});
  std::string piece(shared_piece_bytes, '\0');
  for (std::uint64_t offset = 0;
       in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0;) {
    const auto got = static_cast<std::size_t>(in.gcount());
    append(draft, offset, std::string_view(piece).substr(0, got));
    offset += got;
  }
  try {
    writing_.ask({name_upload, {sql_value(draft), sql_value(path)}});
  } catch (const StorageError&) {
    if (!use(path)) throw;  // else another daemon was faster
  }
  remove({draft});
}

std::optional<std::uint64_t> FleetFiles::use(const std::string& path) {
  return first_size(writing_.ask({use_file, {sql_value(path)}}));
}

void FleetFiles::remove_unused(const std::set<std::string>& needed, std::chrono::seconds age) {
  while (writing_.ask({remove_some, {sql_value(age.count()), array_of(needed)}}).changed() > 0) {
  }
}

}  // namespace sculpt::server
