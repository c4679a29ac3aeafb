#include "core/place/placed_cell.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "core/cell/mesh_reference.hpp"
#include "core/place/urdf_origin.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double same = 1e-12;

void replace_all(std::string& text, const std::string& old, const std::string& by) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
}

fs::path folder_of(const fs::path& file) {
  return fs::weakly_canonical(fs::absolute(file).parent_path());
}

/// `path` as a file in `folder` names it.
std::string as_seen_from(const fs::path& folder, const fs::path& path) {
  return fs::weakly_canonical(fs::absolute(path)).lexically_proximate(folder).generic_string();
}

/// References that depend on where the files are, as they are right for files in another folder.
class References {
 public:
  References(const CellSource& source, const fs::path& to, ordered_json& document)
      : source_(source),
        urdf_(source.path.parent_path() / document.at("urdf").get<std::string>()),
        to_(folder_of(to)),
        document_(document) {}

  void move(std::string& urdf) {
    for (const auto& [reference, bytes] : source_.files.files) {
      if (reference == document_.at("urdf").get<std::string>() || reference.starts_with("file://")) continue;
      if (reference.starts_with("package://"))
        move_package(reference);
      else if (!fs::path(reference).is_absolute())
        for (const char* quote : {"\"", "'"})
          replace_all(urdf, quote + reference + quote,
                      quote + as_seen_from(to_, urdf_.parent_path() / reference) + quote);
    }
  }

 private:
  void move_package(const std::string& reference) {
    const std::string inside = reference.substr(std::string("package://").size());
    const std::string package = inside.substr(0, inside.find('/')), rest = inside.substr(package.size() + 1);
    const auto named = [&](const std::string& name) -> std::optional<fs::path> {
      if (!document_.contains("packages") || !document_["packages"].contains(name)) return std::nullopt;
      return source_.path.parent_path() / document_["packages"][name].get<std::string>();
    };
    if (!moved_.insert(package).second) return;
    fs::path folder = find_mesh_file(reference, urdf_, named);
    for ([[maybe_unused]] const auto& part : fs::path(rest)) folder = folder.parent_path();
    document_["packages"][package] = as_seen_from(to_, folder);
  }

  const CellSource& source_;
  fs::path urdf_, to_;
  ordered_json& document_;
  std::set<std::string> moved_;  ///< packages
};

/// Is the text what was meant? Throws where it is not: then a cell would stand elsewhere than it was rated.
void check(const PlacedCell& placed, const CellSource& source, int joint, const Stand& stand) {
  const Robot robot =
      parse_urdf(placed.urdf, [&](const std::string& reference) { return source.files.files.at(reference); });
  for (std::size_t at = 0; at < robot.joints.size(); ++at) {
    const Frame expected = static_cast<int>(at) == joint ? origin_at(source.cell.robot, joint, stand)
                                                         : source.cell.robot.joints[at].origin;
    if (!robot.joints[at].origin.isApprox(expected, same) &&
        (robot.joints[at].origin.matrix() - expected.matrix()).cwiseAbs().maxCoeff() > same)
      throw std::logic_error("joint '" + robot.joints[at].name + "' stands elsewhere in the written URDF");
  }
}

}  // namespace

PlacedCell place_cell(const CellSource& source, int joint, const Stand& stand, const std::optional<Configuration>& home,
                      const fs::path& to) {
  ordered_json document = ordered_json::parse(source.files.cell_json);
  const Stand own = stand_of(source.cell, joint);
  PlacedCell placed;
  placed.urdf_name = to.stem().string() + ".urdf";
  placed.urdf = source.files.files.at(document.at("urdf").get<std::string>());
  if (stand.at_m != own.at_m || stand.turn_rad != own.turn_rad)
    placed.urdf = move_origin(placed.urdf, source.cell.robot.joints[static_cast<std::size_t>(joint)].name, stand.at_m,
                              stand.turn_rad);
  check(placed, source, joint, stand);
  const fs::path urdf = source.path.parent_path() / document.at("urdf").get<std::string>();
  if (folder_of(to) != folder_of(urdf) || folder_of(to) != folder_of(source.path))
    References(source, to, document).move(placed.urdf);
  document["urdf"] = placed.urdf_name;
  if (stand.height_m != own.height_m) document["stock"]["origin_m"][2] = stand.height_m;
  if (stand.stickout_m != own.stickout_m) document["tool"]["stickout_m"] = stand.stickout_m;
  if (home) {
    const std::vector<std::string> names = source.cell.chain().names();
    for (std::size_t at = 0; at < names.size(); ++at)
      document["home"][names[at]] = (*home)[static_cast<Eigen::Index>(at)];
  }
  placed.cell_json = document.dump(2) + "\n";
  return placed;
}

}  // namespace sculpt
