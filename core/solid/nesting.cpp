#include "core/solid/nesting.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace sculpt {
namespace {

constexpr std::size_t points_a_shell = 8;
constexpr std::size_t max_containers = 1000;

using Units = std::array<std::int64_t, 3>;

/// A point of `shell`, from which a ray goes down x.
struct Probe {
  Units at;
  std::uint32_t shell;
};

/// Shells that are no smaller than another and whose box holds its box.
std::vector<bool> find_containers(const std::vector<Shell>& shells) {
  std::vector<std::size_t> by_size(shells.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(shells[a].volume) > std::abs(shells[b].volume);
  });
  std::vector<bool> is_container(shells.size());
  for (std::size_t at = 0; at < std::min(by_size.size(), max_containers); ++at)
    is_container[by_size[at]] = std::any_of(shells.begin(), shells.end(), [&](const Shell& shell) {
      return &shell != &shells[by_size[at]] && shell.is_body && shells[by_size[at]].box.contains(shell.box);
    });
  return is_container;
}

std::vector<Probe> make_probes(const FixedMesh& mesh, const std::vector<Shell>& shells) {
  std::vector<Probe> probes;
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    const auto& facets = shells[s].facets;
    for (std::size_t p = 0; shells[s].is_body && p < std::min(points_a_shell, facets.size()); ++p) {
      const auto& t = mesh.triangles[facets[p * facets.size() / std::min(points_a_shell, facets.size())]];
      Units at;
      for (int axis = 0; axis < 3; ++axis)
        at[axis] = (mesh.vertices[t[0]][axis] + mesh.vertices[t[1]][axis] + mesh.vertices[t[2]][axis]) / 3;
      probes.push_back({at, s});
    }
  }
  std::stable_sort(probes.begin(), probes.end(), [](const Probe& a, const Probe& b) { return a.at[2] < b.at[2]; });
  return probes;
}

/// +1 or -1 where the ray down x from `at` goes through the facet, by its turn; 0 elsewhere.
int pass(const FixedMesh& mesh, const std::array<std::uint32_t, 3>& t, const Units& at) {
  bool in = false;
  for (int s = 0; s < 3; ++s) {
    const Units *p = &mesh.vertices[t[s]], *q = &mesh.vertices[t[(s + 1) % 3]];
    if (((*p)[2] <= at[2]) == ((*q)[2] <= at[2])) continue;
    if ((*p)[2] > (*q)[2]) std::swap(p, q);
    in ^= ((*q)[1] - (*p)[1]) * (at[2] - (*p)[2]) < (at[1] - (*p)[1]) * ((*q)[2] - (*p)[2]);
  }
  if (!in) return 0;
  const Vec3 a = mesh.at(t[0]), normal = (mesh.at(t[1]) - a).cross(mesh.at(t[2]) - a);
  const Vec3 from = Vec3(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])) - a;
  const double below = from.x() + (normal.y() * from.y() + normal.z() * from.z()) / normal.x();
  return below > 0 ? (normal.x() > 0 ? 1 : -1) : 0;
}

/// How often each shell winds round the points: (shell of the point, shell around it) -> points.
using Counts = std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;

Counts count_points_inside(const FixedMesh& mesh, const std::vector<Shell>& shells,
                           const std::vector<std::uint32_t>& shell_of, const std::vector<bool>& is_container) {
  const auto low = [&](std::uint32_t facet) {
    const auto& t = mesh.triangles[facet];
    return std::min({mesh.vertices[t[0]][2], mesh.vertices[t[1]][2], mesh.vertices[t[2]][2]});
  };
  std::vector<std::uint32_t> facets;
  for (std::uint32_t facet = 0; facet < shell_of.size(); ++facet)
    if (is_container[shell_of[facet]]) facets.push_back(facet);
  std::stable_sort(facets.begin(), facets.end(), [&](auto a, auto b) { return low(a) < low(b); });

  Counts counts;
  std::vector<std::uint32_t> active;
  std::size_t next = 0;
  for (const Probe& probe : make_probes(mesh, shells)) {
    for (; next < facets.size() && low(facets[next]) <= probe.at[2]; ++next) active.push_back(facets[next]);
    std::erase_if(active, [&](std::uint32_t facet) {
      return std::ranges::all_of(mesh.triangles[facet], [&](auto v) { return mesh.vertices[v][2] <= probe.at[2]; });
    });
    std::map<std::uint32_t, int> winding;
    for (std::uint32_t facet : active) {
      const std::uint32_t around = shell_of[facet];
      if (around == probe.shell || !shells[around].box.contains(shells[probe.shell].box)) continue;
      if (const int sign = pass(mesh, mesh.triangles[facet], probe.at)) winding[around] += sign;
    }
    for (const auto& [around, turns] : winding)
      if (turns != 0) ++counts[{probe.shell, around}];
  }
  return counts;
}

}  // namespace

std::vector<int> find_nesting(const FixedMesh& mesh, const std::vector<Shell>& shells,
                              const std::vector<std::uint32_t>& shell_of) {
  std::vector<int> parent(shells.size(), -1);
  const std::vector<bool> is_container = find_containers(shells);
  if (std::none_of(is_container.begin(), is_container.end(), [](bool is) { return is; })) return parent;
  for (const auto& [pair, points] : count_points_inside(mesh, shells, shell_of, is_container)) {
    const auto [inner, around] = pair;
    const double size = std::abs(shells[around].volume);
    if (points < std::min(points_a_shell, shells[inner].facets.size())) continue;
    if (size <= std::abs(shells[inner].volume)) continue;
    int& smallest = parent[inner];
    if (smallest < 0 || size < std::abs(shells[static_cast<std::size_t>(smallest)].volume))
      smallest = static_cast<int>(around);
  }
  return parent;
}

}  // namespace sculpt
