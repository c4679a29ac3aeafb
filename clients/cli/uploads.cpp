#include "clients/cli/uploads.hpp"

#include "proto/cell_bundle.hpp"

namespace sculpt::cli {

Json upload_mesh(client::Client& client, const MeshFile& file) {
  return {{"blob", client.upload(file.bytes)}, {"name", file.name}};
}

Json upload_cell(client::Client& client, const CellFiles& cell) {
  proto::CellBundle bundle{cell.name, cell.cell_json, {}};
  for (const auto& [reference, bytes] : cell.files) bundle.files[reference] = client.upload(bytes);
  return {{"cell", {{"blob", client.upload(proto::write_cell_bundle(bundle))}}}};
}

}  // namespace sculpt::cli
