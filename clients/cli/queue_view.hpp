// What `sculpt top` shows: a daemon's jobs that have not ended, as text of a given size.
#pragma once

#include <map>
#include <string>

#include "clients/cpp/client.hpp"

namespace sculpt::cli {

/// The jobs of a server that have not ended. The first reading goes through all of its jobs, later ones only ask for
/// those that were open and for new ones.
class OpenJobs {
 public:
  /// In the order of submission, running ones first. Throws like Client.
  Json read(client::Client& client);

 private:
  void refresh(client::Client& client);
  void add_new(client::Client& client);

  std::map<std::string, Json> open_;
  std::string last_seen_;
};

/// {"server": result of server.info, "jobs": the open ones}
Json read_queue(client::Client& client, OpenJobs& jobs);

/// Plain lines, none longer than `columns`, with nothing cut off from 80 on; at most `rows` of them, of which the last
/// says how many jobs are left out. 0: no bound.
std::string queue_text(const Json& queue, int columns, int rows);

}  // namespace sculpt::cli
