#include "core/sweep/reach/cell_rows.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/sweep/reach/reach_rows.hpp"

namespace sculpt {
namespace {

bool holds(const std::uint64_t* row, int a) {
  return row[a / 64] >> (a % 64) & 1;
}

TEST(CellRows, HoldTheVoxelsAsEveryDirectionSeesThem) {
  for (int n : {8, 16, 32, 64, 128}) {
    Random random(static_cast<std::uint64_t>(n));
    VoxelSet voxels(n);
    const int full = static_cast<int>(random.next() % static_cast<unsigned>(n));
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          if (k < full / 2 || (k < full && random.unit() < 0.3)) voxels.insert({i, j, k});
    for (const ToolView& view : tool_views(n)) {
      SCOPED_TRACE("n " + std::to_string(n) + ", axis " + std::to_string(view.step[2].i) +
                   std::to_string(view.step[2].j) + std::to_string(view.step[2].k));
      const CellRows rows(view, voxels);
      ASSERT_EQ(rows.chunks(), (n + 63) / 64);
      for (int c = 0; c < n; ++c)
        for (int b = 0; b < n; ++b)
          for (int a = 0; a < 64 * rows.chunks(); ++a)
            ASSERT_EQ(holds(rows.row(b, c), a), a < n && voxels.contains(view.voxel({a, b, c})))
                << a << ' ' << b << ' ' << c;
    }
  }
}

TEST(CellRows, RangesAreTheCellsFromFirstToLast) {
  Random random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    CellRows rows(200, 1, 1);
    std::uint64_t* row = rows.row(0, 0);
    const auto place = [&] { return static_cast<int>(random.next() % 200); };
    int first = place(), last = place(), from = place(), to = place();
    if (first > last) std::swap(first, last);
    if (from > to) std::swap(from, to);
    set_cells(row, first, last);
    int inside = 0;
    for (int a = 0; a < 200; ++a) ASSERT_EQ(holds(row, a), first <= a && a <= last) << a;
    for (int a = from; a <= to; ++a) inside += holds(row, a);
    ASSERT_EQ(any_cell(row, from, to), inside > 0);
    ASSERT_EQ(all_cells(row, from, to), inside == to - from + 1);
    clear_cells(row, from, to);
    for (int a = 0; a < 200; ++a) ASSERT_EQ(holds(row, a), first <= a && a <= last && (a < from || a > to)) << a;
  }
}

TEST(ReachRows, SayOfEachCellWhatIsSaidOfItsPart) {
  for (int n : {8, 64, 128}) {
    SCOPED_TRACE("n " + std::to_string(n));
    const auto part = [n](const Vec3& cell) {
      const auto at = [n](double x) { return static_cast<int>((x + 0.5) * 21 / (n + 2)); };
      return Voxel{at(cell.x()), at(cell.y()), at(cell.z())};
    };
    const auto reachable = [](Voxel in) {
      return mix(mix(static_cast<std::uint64_t>(in.i), static_cast<std::uint64_t>(in.j)),
                 static_cast<std::uint64_t>(in.k)) %
                 3 >
             0;
    };
    const ReachRows reach(n, part, reachable);
    for (int c = 0; c <= n; ++c)
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a)
          ASSERT_EQ(holds(reach.row(b, c), a), reachable(part({double(a), double(b), double(c)})))
              << a << ' ' << b << ' ' << c;
  }
}

}  // namespace
}  // namespace sculpt
