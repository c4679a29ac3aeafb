#include "proto/cell_bundle.hpp"

#include "proto/fields.hpp"

namespace sculpt::proto {
namespace {

constexpr std::size_t max_cell_bytes = 1 << 20;

}  // namespace

std::string write_cell_bundle(const CellBundle& bundle) {
  Json files = Json::object();
  for (const auto& [reference, sha256] : bundle.files) files[reference] = {{"blob", sha256}};
  return write_json({{"name", bundle.name}, {"cell", bundle.cell_json}, {"files", std::move(files)}});
}

CellBundle read_cell_bundle(std::string_view bytes) {
  Json json;
  try {
    json = parse_json(bytes);
  } catch (const JsonError& error) {
    throw ProtocolError("params_invalid", std::string("the cell bundle is not JSON: ") + error.what());
  }
  Fields fields(json, "/cell_bundle");
  CellBundle bundle{fields.text("name", max_name_bytes), fields.text("cell", max_cell_bytes), {}};
  Fields files = fields.object("files");
  for (const auto& [reference, ignored] : fields.value("files").items()) {
    Fields file = files.object(reference);
    bundle.files[reference] = file.sha256("blob");
    file.done();
  }
  fields.done();
  return bundle;
}

}  // namespace sculpt::proto
