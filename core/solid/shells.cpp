#include "core/solid/shells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/solid/facet_groups.hpp"
#include "core/solid/holes.hpp"
#include "core/solid/nesting.hpp"
#include "core/solid/surface/twins.hpp"

namespace sculpt {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

/// Which shell each facet belongs to, and which shells are twisted: no turn of their facets fits all their edges.
struct Partition {
  std::vector<std::uint32_t> shell_of;
  std::vector<bool> twisted;
  std::vector<bool> turned;  ///< facets
};

/// Turns the facets of each shell as most of them are.
Partition turn_alike(FixedMesh& mesh, const std::vector<Side>& sides) {
  FacetGroups groups(mesh.triangles.size());
  std::vector<std::uint32_t> misfits;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() == 2 && !groups.join(edge[0].facet, edge[1].facet, edge[0].forward == edge[1].forward))
      misfits.push_back(edge[0].facet);
  });
  Partition parts{std::vector<std::uint32_t>(mesh.triangles.size()), {}, std::vector<bool>(mesh.triangles.size())};
  std::vector<std::uint32_t> shell_of_root(mesh.triangles.size(), none);
  std::vector<std::int64_t> turned;  // of each shell: facets turned against the root, less those that are not
  for (std::uint32_t facet = 0; facet < mesh.triangles.size(); ++facet) {
    const auto [root, is_turned] = groups.find(facet);
    if (shell_of_root[root] == none) {
      shell_of_root[root] = static_cast<std::uint32_t>(turned.size());
      turned.push_back(0);
    }
    parts.shell_of[facet] = shell_of_root[root];
    turned[shell_of_root[root]] += is_turned ? 1 : -1;
  }
  for (std::uint32_t facet = 0; facet < mesh.triangles.size(); ++facet)
    if (groups.find(facet).turned != (turned[parts.shell_of[facet]] > 0)) {
      parts.turned[facet] = true;
      std::swap(mesh.triangles[facet][1], mesh.triangles[facet][2]);
    }
  parts.twisted.resize(turned.size());
  for (std::uint32_t facet : misfits) parts.twisted[parts.shell_of[facet]] = true;
  return parts;
}

double area_of(const FixedMesh& mesh, std::uint32_t facet) {
  const auto& [a, b, c] = mesh.triangles[facet];
  return (mesh.at(b) - mesh.at(a)).cross(mesh.at(c) - mesh.at(a)).norm() / 2;
}

/// Six times the signed volume between a facet and `from`.
double volume_of(const FixedMesh& mesh, std::uint32_t facet, const Vec3& from) {
  const auto& [a, b, c] = mesh.triangles[facet];
  return (mesh.at(a) - from).dot((mesh.at(b) - from).cross(mesh.at(c) - from));
}

/// The edges at which the facets of one shell do not cancel each other. `sides`: before facets were turned.
std::vector<OpenEdge> find_ends(const std::vector<Side>& sides, const Partition& parts) {
  std::vector<OpenEdge> ends;
  std::vector<std::pair<std::uint32_t, int>> sums;
  const auto is_forward = [&](const Side& side) { return side.forward != parts.turned[side.facet]; };
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() == 2 && is_forward(edge[0]) != is_forward(edge[1])) return;  // joined, so of one shell
    sums.clear();
    for (const Side& side : edge) {
      const std::uint32_t shell = parts.shell_of[side.facet];
      const auto known = std::ranges::find(sums, shell, &std::pair<std::uint32_t, int>::first);
      (known == sums.end() ? sums.emplace_back(shell, 0) : *known).second += is_forward(side) ? 1 : -1;
    }
    for (const auto& [shell, sum] : sums)
      if (sum != 0) ends.push_back({shell, edge[0].low, edge[0].high});
  });
  return ends;
}

/// Shells that are far from closed: their holes, taken as round, have more than a fifth of their area.
std::vector<bool> find_sheets(const FixedMesh& mesh, const std::vector<Side>& sides, const Partition& parts) {
  std::vector<double> hole(parts.twisted.size()), area(parts.twisted.size());
  for (const Hole& each : find_holes(mesh, find_ends(sides, parts)))
    hole[each.group] += each.length * each.length / (4 * std::numbers::pi);
  for (std::uint32_t facet = 0; facet < mesh.triangles.size(); ++facet)
    area[parts.shell_of[facet]] += area_of(mesh, facet);
  std::vector<bool> sheet(area.size());
  for (std::size_t s = 0; s < area.size(); ++s) sheet[s] = hole[s] > 0.2 * area[s];
  return sheet;
}

/// The shells that are bodies, each by itself, and all sheets as one.
std::vector<Shell> collect_shells(const FixedMesh& mesh, const std::vector<bool>& sheet,
                                  std::vector<std::uint32_t>& shell_of) {
  std::vector<std::uint32_t> number(sheet.size(), none);
  std::vector<Shell> shells;
  std::uint32_t all_sheets = none;
  for (std::uint32_t facet = 0; facet < shell_of.size(); ++facet) {
    std::uint32_t& place = sheet[shell_of[facet]] ? all_sheets : number[shell_of[facet]];
    if (place == none) {
      place = static_cast<std::uint32_t>(shells.size());
      shells.emplace_back();
      shells.back().is_body = !sheet[shell_of[facet]];
    }
    shell_of[facet] = place;
    shells[place].facets.push_back(facet);
    for (std::uint32_t v : mesh.triangles[facet]) shells[place].box.extend(mesh.at(v));
  }
  for (Shell& shell : shells)
    for (std::uint32_t facet : shell.facets) shell.volume += volume_of(mesh, facet, shell.box.center()) / 6;
  return shells;
}

void turn(FixedMesh& mesh, const Shell& shell) {
  for (std::uint32_t facet : shell.facets) std::swap(mesh.triangles[facet][1], mesh.triangles[facet][2]);
}

/// Turns every outermost shell outwards, what lies in it along with it, and says what each bounds.
class Turning {
 public:
  Turning(const std::vector<Shell>& shells, std::vector<int> parent)
      : shells_(shells), parent_(std::move(parent)), roles_(shells.size()), known_(shells.size()) {
    for (std::size_t s = 0; s < shells.size(); ++s)
      if (parent_[s] < 0) outwards_ += shells[s].volume;
  }

  /// Parents are larger than what lies in them, so this ends.
  Role role(std::size_t shell) {
    if (known_[shell]) return roles_[shell];
    known_[shell] = true;
    return roles_[shell] =
               parent_[shell] < 0 ? outer_role(shell) : inner_role(shell, static_cast<std::size_t>(parent_[shell]));
  }

  bool faces_inwards(std::size_t shell) { return (shells_[shell].volume < 0) != is_cavity(role(shell)); }

 private:
  static bool is_cavity(Role role) { return role == Role::cavity || role == Role::doubtful_cavity; }

  Role outer_role(std::size_t shell) const {
    return (shells_[shell].volume < 0) == (outwards_ < 0) ? Role::solid : Role::doubtful_solid;
  }

  Role inner_role(std::size_t shell, std::size_t parent) {
    const bool alike = (shells_[shell].volume < 0) == (shells_[parent].volume < 0);
    const bool in_cavity = is_cavity(role(parent));
    if (alike) return in_cavity ? Role::doubtful_cavity : Role::doubtful_solid;
    return in_cavity ? Role::solid : Role::cavity;
  }

  const std::vector<Shell>& shells_;
  std::vector<int> parent_;
  std::vector<Role> roles_;
  std::vector<bool> known_;
  double outwards_ = 0;  // above 0 where the file turns most of its volume outwards
};

}  // namespace

Surface turn_shells(FixedMesh mesh) {
  std::vector<Side> sides = sort_sides(mesh.triangles, mesh.vertices.size());
  while (halve_twins(mesh, sides)) sides = sort_sides(mesh.triangles, mesh.vertices.size());
  Partition parts = turn_alike(mesh, sides);
  std::vector<bool> twisted(mesh.triangles.size()), sheet(mesh.triangles.size());
  const std::vector<bool> sheets = find_sheets(mesh, sides, parts);
  for (std::size_t facet = 0; facet < sheet.size(); ++facet) {
    twisted[facet] = parts.twisted[parts.shell_of[facet]];
    sheet[facet] = sheets[parts.shell_of[facet]];
  }
  const std::vector<Shell> shells = collect_shells(mesh, sheets, parts.shell_of);
  Turning turning(shells, find_nesting(mesh, shells, parts.shell_of));
  std::vector<Role> role(mesh.triangles.size());
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (turning.faces_inwards(s)) turn(mesh, shells[s]);
    for (std::uint32_t facet : shells[s].facets) role[facet] = twisted[facet] ? Role::unturned : turning.role(s);
  }
  return {std::move(mesh), std::move(role), std::move(sheet)};
}

}  // namespace sculpt
