#include "core/sweep/reach/reach_rows.hpp"

#include <algorithm>

namespace sculpt {
namespace {

/// The cells of one part along one axis.
struct Span {
  int part, first, last;
};

/// `at(x)` is the part of cell x.
template <typename At>
std::vector<Span> find_spans(int count, const At& at) {
  std::vector<Span> spans;
  for (int x = 0; x < count; ++x) {
    const int part = at(x);
    if (spans.empty() || spans.back().part != part) spans.push_back({part, x, x});
    spans.back().last = x;
  }
  return spans;
}

/// For each cell the place of its span.
std::vector<int> number_cells(const std::vector<Span>& spans) {
  std::vector<int> number_of;
  for (std::size_t at = 0; at < spans.size(); ++at)
    number_of.resize(static_cast<std::size_t>(spans[at].last) + 1, static_cast<int>(at));
  return number_of;
}

}  // namespace

ReachRows::ReachRows(int n, const std::function<Voxel(const Vec3&)>& part, const std::function<bool(Voxel)>& reachable)
    : rows_(0, 0, 0) {
  const std::vector<Span> as = find_spans(n, [&](int a) { return part({double(a), 0, 0}).i; });
  const std::vector<Span> bs = find_spans(n, [&](int b) { return part({0, double(b), 0}).j; });
  const std::vector<Span> cs = find_spans(n + 1, [&](int c) { return part({0, 0, double(c)}).k; });
  row_of_ = number_cells(bs);
  layer_of_ = number_cells(cs);
  rows_ = CellRows(n, row_of_.back() + 1, layer_of_.back() + 1);
  for (std::size_t c = 0; c < cs.size(); ++c)
    for (std::size_t b = 0; b < bs.size(); ++b) {
      std::uint64_t* row = rows_.row(static_cast<int>(b), static_cast<int>(c));
      const auto is_reachable = [&](const Span& a) { return reachable({a.part, bs[b].part, cs[c].part}); };
      for (auto from = as.begin(); (from = std::find_if(from, as.end(), is_reachable)) != as.end();) {
        const auto to = std::find_if_not(from + 1, as.end(), is_reachable);
        set_cells(row, from->first, (to - 1)->last);
        from = to;
      }
    }
}

}  // namespace sculpt
