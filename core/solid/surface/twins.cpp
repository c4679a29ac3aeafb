#include "core/solid/surface/twins.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "core/solid/facet_groups.hpp"

namespace sculpt {
namespace {

/// A facet's corners from the lowest on, and whether it goes round them upwards.
struct Corners {
  std::array<std::uint32_t, 3> ids;
  bool upwards;
  std::uint32_t facet;
};

Corners sort_corners(const FixedMesh& mesh, std::uint32_t facet) {
  auto ids = mesh.triangles[facet];
  std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
  const bool upwards = ids[1] < ids[2];
  if (!upwards) std::swap(ids[1], ids[2]);
  return {ids, upwards, facet};
}

/// Facets that share both their first side and their opposite corner.
std::vector<Corners> find_twins(const FixedMesh& mesh, const std::vector<Side>& sides) {
  std::vector<Corners> twins, here;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() < 2) return;
    here.clear();
    for (const Side& side : edge) {
      const Corners corners = sort_corners(mesh, side.facet);
      if (corners.ids[0] == side.low && corners.ids[1] == side.high) here.push_back(corners);
    }
    std::sort(here.begin(), here.end(), [](const Corners& a, const Corners& b) {
      return std::tie(a.ids[2], b.upwards, a.facet) < std::tie(b.ids[2], a.upwards, b.facet);
    });
    for (std::size_t at = 0; at < here.size(); ++at)
      if ((at > 0 && here[at - 1].ids == here[at].ids) || (at + 1 < here.size() && here[at + 1].ids == here[at].ids))
        twins.push_back(here[at]);
  });
  return twins;
}

/// What meets at the edges of a patch of twins.
struct Rim {
  bool even = false, odd = false;   ///< edges with an even or odd number of other facets
  bool folded = false;              ///< two other facets lie almost in one another: copies that are not exact
  std::size_t edges = 0, ends = 0;  ///< where twins meet twins, and where twins end

  bool says_nothing() const { return folded || (even ? odd : !odd && 10 * ends > edges); }
};

/// Do the two facets lie on the same side of the edge, less than 8 degrees apart?
bool are_folded(const FixedMesh& mesh, const Side& a, const Side& b) {
  const Vec3 along = (mesh.at(a.high) - mesh.at(a.low)).normalized();
  const auto across = [&](const Side& side) -> Vec3 {
    const auto& t = mesh.triangles[side.facet];
    const std::uint32_t tip = t[0] + t[1] + t[2] - side.low - side.high;  // modulo 2^32
    const Vec3 to_tip = mesh.at(tip) - mesh.at(side.low);
    return (to_tip - along * along.dot(to_tip)).normalized();
  };
  return across(a).dot(across(b)) > 0.99;
}

std::vector<Rim> find_rims(const FixedMesh& mesh, const std::vector<Side>& sides, const std::vector<bool>& is_twin,
                           FacetGroups& patches) {
  std::vector<Rim> rims(is_twin.size());
  const auto is_twin_side = [&](const Side& side) { return is_twin[side.facet]; };
  for_each_edge(sides, [&](std::span<const Side> edge) {
    const auto first = std::find_if(edge.begin(), edge.end(), is_twin_side);
    if (first == edge.end()) return;
    for (const Side& side : edge)
      if (is_twin[side.facet]) patches.join(first->facet, side.facet, false);
  });
  std::vector<Side> others;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    const auto first = std::find_if(edge.begin(), edge.end(), is_twin_side);
    if (first == edge.end()) return;
    others.clear();
    std::ranges::copy_if(edge, std::back_inserter(others), [&](const Side& side) { return !is_twin[side.facet]; });
    Rim& rim = rims[patches.find(first->facet).root];
    rim.odd |= others.size() % 2 != 0;
    rim.even |= !others.empty() && others.size() % 2 == 0;
    rim.folded |= others.size() == 2 && are_folded(mesh, others[0], others[1]);
    rim.edges += others.empty();
    rim.ends += others.empty() && edge.size() % 4 != 0;
  });
  return rims;
}

}  // namespace

bool halve_twins(FixedMesh& mesh, const std::vector<Side>& sides) {
  const std::vector<Corners> twins = find_twins(mesh, sides);
  if (twins.empty()) return false;
  std::vector<bool> is_twin(mesh.triangles.size()), goes(mesh.triangles.size());
  for (const Corners& twin : twins) is_twin[twin.facet] = true;
  FacetGroups patches(mesh.triangles.size());
  const std::vector<Rim> rims = find_rims(mesh, sides, is_twin, patches);
  for (std::size_t first = 0, end = 0; first < twins.size(); first = end) {
    while (end < twins.size() && twins[end].ids == twins[first].ids) ++end;
    const Rim rim = rims[patches.find(twins[first].facet).root];
    if (rim.says_nothing()) continue;
    const std::size_t copies = end - first;
    for (std::size_t at = first; at < end; ++at)
      goes[twins[at].facet] = rim.even ? at - first < copies / 2 * 2 : (at - first) % 2 != 0;
  }
  Triangles left;
  for (std::size_t facet = 0; facet < mesh.triangles.size(); ++facet)
    if (!goes[facet]) left.push_back(mesh.triangles[facet]);
  const bool changed = left.size() < mesh.triangles.size();
  mesh.triangles = std::move(left);
  return changed;
}

}  // namespace sculpt
