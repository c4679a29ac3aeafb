#include "tests/core/mill/solids.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace sculpt::milled {
namespace {

constexpr int turned_facets = 120;

using Corner = std::array<double, 3>;

class Stl {
 public:
  void add(const Corner& a, const Corner& b, const Corner& c) {
    std::array<float, 12> numbers{};
    std::size_t at = 3;
    for (const Corner* corner : {&a, &b, &c})
      for (const double value : *corner) numbers[at++] = static_cast<float>(value);
    triangles_.append(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
    triangles_.append(2, '\0');
    ++count_;
  }
  void add(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    add(a, b, c);
    add(a, c, d);
  }
  std::string bytes() const {
    std::string stl(80, ' ');
    stl.append(reinterpret_cast<const char*>(&count_), sizeof(count_));
    return stl + triangles_;
  }

 private:
  std::string triangles_;
  std::uint32_t count_ = 0;
};

}  // namespace

std::string height_field(const std::vector<double>& lines, const std::function<double(double, double)>& height) {
  Stl stl;
  const std::size_t last = lines.size() - 1;
  const auto top = [&](std::size_t i, std::size_t j) { return Corner{lines[i], lines[j], height(lines[i], lines[j])}; };
  const auto floor = [&](std::size_t i, std::size_t j) { return Corner{lines[i], lines[j], 0}; };
  for (std::size_t i = 0; i < last; ++i) {
    for (std::size_t j = 0; j < last; ++j) {
      stl.add(top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1));
      stl.add(floor(i, j), floor(i, j + 1), floor(i + 1, j + 1), floor(i + 1, j));
    }
    stl.add(floor(i, 0), floor(i + 1, 0), top(i + 1, 0), top(i, 0));
    stl.add(floor(i + 1, last), floor(i, last), top(i, last), top(i + 1, last));
    stl.add(floor(0, i + 1), floor(0, i), top(0, i), top(0, i + 1));
    stl.add(floor(last, i), floor(last, i + 1), top(last, i + 1), top(last, i));
  }
  return stl.bytes();
}

std::string height_field(double side_mm, int squares, const std::function<double(double, double)>& height) {
  std::vector<double> lines;
  for (int line = 0; line <= squares; ++line) lines.push_back(side_mm * line / squares);
  return height_field(lines, height);
}

std::vector<double> lines_with_steps(double side_mm, const std::vector<double>& steps) {
  std::vector<double> lines{0, side_mm};
  for (const double step : steps) lines.insert(lines.end(), {step - 1e-3, step + 1e-3});
  for (double line = 2.1; line < side_mm; line += 2) lines.push_back(line);
  std::ranges::sort(lines);
  return lines;
}

std::string turned(const std::vector<std::array<double, 2>>& outline) {
  Stl stl;
  const auto corner = [&](std::size_t at, int facet) {
    const double angle = 2 * std::numbers::pi * facet / turned_facets;
    return Corner{outline[at][0] * std::cos(angle), outline[at][0] * std::sin(angle), outline[at][1]};
  };
  for (std::size_t at = 0; at + 1 < outline.size(); ++at)
    for (int facet = 0; facet < turned_facets; ++facet) {
      const Corner a = corner(at, facet), b = corner(at, (facet + 1) % turned_facets),
                   c = corner(at + 1, (facet + 1) % turned_facets), d = corner(at + 1, facet);
      if (outline[at][0] > 0) stl.add(a, b, c);
      if (outline[at + 1][0] > 0) stl.add(a, c, d);
    }
  return stl.bytes();
}

}  // namespace sculpt::milled
