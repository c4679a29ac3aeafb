#include "core/sweep/reach_rows.hpp"

namespace sculpt {
namespace {

/// First cells of the parts along one axis of `count` cells, then `count`; `at(x)` is the part of cell x.
template <typename At>
std::vector<int> find_starts(int count, const At& at) {
  std::vector<int> starts{0};
  for (int x = 1; x < count; ++x)
    if (at(x) != at(x - 1)) starts.push_back(x);
  starts.push_back(count);
  return starts;
}

std::vector<int> number_parts(const std::vector<int>& starts) {
  std::vector<int> number_of;
  for (std::size_t part = 0; part + 1 < starts.size(); ++part)
    number_of.resize(static_cast<std::size_t>(starts[part + 1]), static_cast<int>(part));
  return number_of;
}

}  // namespace

ReachRows::ReachRows(int n, const std::function<bool(const Vec3&)>& reachable,
                     const std::function<Voxel(const Vec3&)>& part)
    : rows_(0, 0, 0) {
  const std::vector<int> as = find_starts(n, [&](int a) { return part({double(a), 0, 0}).i; });
  const std::vector<int> bs = find_starts(n, [&](int b) { return part({0, double(b), 0}).j; });
  const std::vector<int> cs = find_starts(n + 1, [&](int c) { return part({0, 0, double(c)}).k; });
  row_of_ = number_parts(bs);
  layer_of_ = number_parts(cs);
  rows_ = CellRows(n, row_of_.back() + 1, layer_of_.back() + 1);
  for (std::size_t c = 0; c + 1 < cs.size(); ++c)
    for (std::size_t b = 0; b + 1 < bs.size(); ++b) {
      std::uint64_t* row = rows_.row(static_cast<int>(b), static_cast<int>(c));
      for (std::size_t a = 0; a + 1 < as.size(); ++a)
        if (reachable({double(as[a]), double(bs[b]), double(cs[c])})) set_cells(row, as[a], as[a + 1] - 1);
    }
}

}  // namespace sculpt
