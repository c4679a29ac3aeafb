// A cell file and its URDF, with a NUL between them; the URDF has the name that the cell file gives it.
#include "core/cell/cell.hpp"

#include "core/base/error.hpp"
#include "tests/fuzz/target.hpp"

void read_hostile(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  sculpt::CellFiles files;
  files.name = "hostile";
  files.cell_json = bytes.substr(0, end);
  files.files["robot.urdf"] = bytes.substr(std::min(end + 1, bytes.size()));
  try {
    sculpt::parse_cell(files);
  } catch (const sculpt::InputError&) {
  }
}
