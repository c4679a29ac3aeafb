// The files of a fleet that has no folder in common: in its database, in pieces.
#pragma once

#include <mutex>

#include "server/files/shared_files.hpp"
#include "server/fleet/postgres.hpp"

namespace sculpt::server {

/// Reading and writing have a connection each, so that a download does not wait for what a run stores.
class FleetFiles : public SharedFiles {
 public:
  /// The database must have today's tables.
  explicit FleetFiles(const PostgresSource& source);

  std::optional<std::uint64_t> size(const std::string& path) override;
  std::string read(const std::string& path, std::uint64_t offset, std::uint64_t bytes) override;
  std::map<std::string, std::uint64_t> files_of(const std::string& job) override;
  std::map<std::string, std::uint64_t> bytes_of_jobs() override;
  bool make(const std::string& job, int attempt, const std::string& path) override;
  void append(const std::string& path, std::uint64_t offset, std::string_view bytes) override;
  void replace(const std::string& path, std::string_view bytes) override;
  void remove(const std::set<std::string>& paths) override;
  void upload(const std::filesystem::path& from, const std::string& path) override;
  std::optional<std::uint64_t> use(const std::string& path) override;
  void remove_unused(const std::set<std::string>& needed, std::chrono::seconds age) override;

 private:
  struct Connection {
    std::mutex mutex;
    Postgres database;

    Answered ask(const Question& question);
    std::vector<Answered> ask_all(const std::vector<Question>& questions);
  };
  std::map<std::string, std::uint64_t> sizes(const Question& question);

  Connection reading_, writing_;
};

}  // namespace sculpt::server
