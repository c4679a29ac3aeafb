// Files of this disk -> blobs of the server, as its requests name them.
#pragma once

#include "clients/cpp/client.hpp"
#include "core/plan/job.hpp"

namespace sculpt::cli {

/// The fields of a mesh. Throws what Client::upload throws.
Json upload_mesh(client::Client& client, const MeshFile& file);

/// The field `robot` for a cell that the server does not have. Throws the same.
Json upload_cell(client::Client& client, const CellFiles& cell);

}  // namespace sculpt::cli
