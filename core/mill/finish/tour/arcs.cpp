#include "core/mill/finish/tour/arcs.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "core/mill/finish/tour/place_boxes.hpp"

namespace sculpt {
namespace {

/// Where a contour is cut already another may touch it, if that is so many times as far as where they are nearest, and
/// so much of what counts as near.
constexpr double farther = 1.3, farther_share = 0.05;
/// A contour whose ends are no farther apart is a ring.
constexpr double ring_joint_m = 1e-9;

/// Where two contours are nearest: their numbers, and those of the vertices.
struct Touch {
  double far_m = 0;
  std::uint32_t a = 0, b = 0, at_a = 0, at_b = 0;
};

/// Of one contour after the other where it comes near to later ones.
class TouchFinder {
 public:
  TouchFinder(const std::vector<Contour>& contours, double near_m) : near_m_(near_m), touch_of_(contours.size(), none) {
    for (std::uint32_t number = 0; number < contours.size(); ++number)
      for (std::uint32_t vertex = 0; vertex < contours[number].size(); ++vertex) {
        places_.push_back(contours[number][vertex]);
        vertices_.emplace_back(number, vertex);
      }
  }

  /// The nearest of each two; the nearest of all first.
  std::vector<Touch> run() {
    const PlaceBoxes boxes(places_, near_m_);
    std::size_t begin = 0;
    for (std::uint32_t p = 0; p < places_.size(); ++p) {
      // A new contour.
      if (vertices_[p].second == 0)
        for (; begin < touches_.size(); ++begin) touch_of_[touches_[begin].b] = none;
      boxes.for_each_near(places_[p], 1, [&](std::uint32_t q) { look(p, q); });
    }
    std::ranges::sort(touches_, {}, [](const Touch& touch) { return std::tuple(touch.far_m, touch.a, touch.b); });
    return std::move(touches_);
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  void look(std::uint32_t p, std::uint32_t q) {
    const double far = (places_[p] - places_[q]).norm();
    const Touch touch{far, vertices_[p].first, vertices_[q].first, vertices_[p].second, vertices_[q].second};
    if (touch.a >= touch.b || far > near_m_) return;
    std::size_t& known = touch_of_[touch.b];
    if (known == none) {
      known = touches_.size();
      touches_.push_back(touch);
    } else if (far < touches_[known].far_m) {
      touches_[known] = touch;
    }
  }

  double near_m_;
  std::vector<Vec3> places_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices_;
  std::vector<Touch> touches_;
  std::vector<std::size_t> touch_of_;  ///< of each contour the one with that which is looked at, if there is one
};

/// Of each contour the edges of the tree that touch it, itself as `a`.
std::vector<std::vector<Touch>> find_tree(std::size_t count, const std::vector<Touch>& touches) {
  std::vector<std::uint32_t> root(count);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::uint32_t number) {
    while (root[number] != number) number = root[number] = root[root[number]];
    return number;
  };
  std::vector<std::vector<Touch>> tree(count);
  for (const Touch& touch : touches) {
    const std::uint32_t a = find(touch.a), b = find(touch.b);
    if (a == b) continue;
    root[a] = b;
    tree[touch.a].push_back(touch);
    tree[touch.b].push_back({touch.far_m, touch.b, touch.a, touch.at_b, touch.at_a});
  }
  return tree;
}

class ArcMaker {
 public:
  ArcMaker(const std::vector<Contour>& contours, double near_m)
      : contours_(contours), near_m_(near_m), cuts_(contours.size()) {
    for (std::uint32_t number = 0; number < contours.size(); ++number)
      if (!is_ring(contours[number])) cuts_[number] = {0, static_cast<std::uint32_t>(contours[number].size() - 1)};
  }

  std::vector<Contour> run() {
    const auto tree = find_tree(contours_.size(), TouchFinder(contours_, near_m_).run());
    std::vector<char> is_seen(contours_.size());
    for (std::uint32_t first = 0; first < contours_.size(); ++first) {
      if (is_seen[first] != 0) continue;
      is_seen[first] = 1;
      std::vector<std::uint32_t> line{first};
      for (std::size_t next = 0; next < line.size(); ++next)
        for (const Touch& touch : tree[line[next]]) {
          if (is_seen[touch.b] != 0) continue;
          is_seen[touch.b] = 1;
          line.push_back(touch.b);
          cut_at(touch);
        }
    }
    std::vector<Contour> arcs;
    for (std::uint32_t number = 0; number < contours_.size(); ++number) add_arcs(number, arcs);
    return arcs;
  }

 private:
  static bool is_ring(const Contour& contour) {
    return contour.size() > 3 && (contour.front() - contour.back()).norm() < ring_joint_m;
  }

  /// Rather where one is cut already: so from ring to ring it goes on where it came in.
  void cut_at(Touch touch) {
    const double enough = farther * touch.far_m + farther_share * near_m_;
    double least = enough;
    for (const std::uint32_t a : cuts_[touch.a])
      for (std::uint32_t b = 0; b < contours_[touch.b].size(); ++b)
        if (const double far = (contours_[touch.a][a] - contours_[touch.b][b]).norm(); far < least)
          least = far, touch.at_a = a, touch.at_b = b;
    const Vec3& place = contours_[touch.a][touch.at_a];
    const auto cut = std::ranges::find_if(
        cuts_[touch.b], [&](std::uint32_t b) { return (place - contours_[touch.b][b]).norm() < enough; });
    if (cut != cuts_[touch.b].end()) touch.at_b = *cut;
    cuts_[touch.a].insert(touch.at_a);
    cuts_[touch.b].insert(touch.at_b);
  }

  void add_arcs(std::uint32_t number, std::vector<Contour>& arcs) const {
    Contour contour = contours_[number];
    std::vector<std::uint32_t> cuts(cuts_[number].begin(), cuts_[number].end());
    if (is_ring(contour)) {
      const auto length = static_cast<std::uint32_t>(contour.size() - 1);
      if (!cuts.empty() && cuts.back() == length) cuts.back() = 0;
      std::ranges::sort(cuts);
      cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
      if (cuts.empty()) cuts.push_back(0);
      const std::uint32_t begin = cuts.front();
      contour.pop_back();
      std::rotate(contour.begin(), contour.begin() + begin, contour.end());
      contour.push_back(contour.front());
      for (std::uint32_t& cut : cuts) cut -= begin;
      cuts.push_back(length);
    }
    for (std::size_t at = 0; at + 1 < cuts.size(); ++at)
      arcs.emplace_back(contour.begin() + cuts[at], contour.begin() + cuts[at + 1] + 1);
  }

  const std::vector<Contour>& contours_;
  double near_m_;
  std::vector<std::set<std::uint32_t>> cuts_;  ///< vertices
};

}  // namespace

std::vector<Contour> cut_where_near(const std::vector<Contour>& contours, double near_m) {
  return ArcMaker(contours, near_m).run();
}

}  // namespace sculpt
