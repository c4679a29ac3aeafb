// job.list: a window of the store -> the page that a client gets.
#pragma once

#include "proto/messages.hpp"
#include "server/events/job_view.hpp"

namespace sculpt::server {

/// At most `list.limit` jobs, fewer where the reply line would become longer than `max_line` bytes. Rows that cannot be
/// read are named beside the others. Reads the store: not on the I/O thread.
Json job_page(const ViewSources& sources, const proto::ListParams& list, std::size_t max_line);

}  // namespace sculpt::server
