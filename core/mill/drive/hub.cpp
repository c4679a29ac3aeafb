#include "core/mill/drive/hub.hpp"

#include <algorithm>
#include <vector>

#include "core/mill/drive/held_tool.hpp"
#include "core/mill/drive/hop.hpp"

namespace sculpt {
namespace {

/// So many columns are gone down on trial, at each height.
constexpr int most_tries = 40;

/// Some of its cells' middles, those nearest to its own first.
std::vector<Point2> columns_from_middle(const Lattice& lattice) {
  std::vector<Point2> columns;
  for (int b = 0; b < lattice.height; b += 4)
    for (int a = 0; a < lattice.width; a += 4) columns.emplace_back(lattice.u(a), lattice.v(b));
  const Point2 middle(lattice.u(lattice.width / 2), lattice.v(lattice.height / 2));
  std::ranges::stable_sort(columns, {}, [&](const Point2& at) { return (at - middle).norm(); });
  return columns;
}

}  // namespace

std::optional<Vec3> find_hub(const Site& site, const ReachFloor& reach, const PostureField& field, const Grid& around,
                             double room_m, const std::function<bool(const Vec3& hub, const Vec3& low)>& goes_down) {
  const std::vector<Point2> columns = columns_from_middle(site.lattice());
  const auto is_held = [&](const Vec3& at) {
    return reach.allows(at) && field.usable(HeldTool::cell_of(field, around, site.frame().point(at)));
  };
  const auto low = [&](const Point2& column) {
    const Vec3 at(column.x(), column.y(), 0);
    return Vec3(column.x(), column.y(), site.clear_height(at, at, 2 * air_clearance_m, air_beside_m));
  };
  const double top = site.top();
  for (const auto& [above_m, comes_down] : {std::pair{room_m, true},
                                            {room_m / 2, true},
                                            {2 * air_clearance_m, true},
                                            {room_m, false},
                                            {room_m / 2, false},
                                            {2 * air_clearance_m, false}}) {
    int tries = most_tries;
    const auto found = std::ranges::find_if(columns, [&, height = top + above_m, down = comes_down](const Point2& p) {
      if (!is_held({p.x(), p.y(), height}) || low(p).z() > height) return false;
      return !down || (reach.allows(low(p)) && tries-- > 0 && goes_down({p.x(), p.y(), height}, low(p)));
    });
    if (found != columns.end()) return Vec3(found->x(), found->y(), top + above_m);
  }
  const auto found = std::ranges::find_if(columns, [&](const Point2& column) { return is_held(low(column)); });
  return found == columns.end() ? std::nullopt : std::optional(low(*found));
}

}  // namespace sculpt
