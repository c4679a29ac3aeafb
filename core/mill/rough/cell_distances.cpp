#include "core/mill/rough/cell_distances.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

std::vector<float> distances_to(const std::vector<char>& marked, const Lattice& lattice, int far) {
  const int w = lattice.width, h = lattice.height;
  const auto most = static_cast<float>(far * far);
  std::vector<float> along(lattice.size()), squares(lattice.size(), most);
  std::vector<char> any(static_cast<std::size_t>(h));
  for (int b = 0; b < h; ++b) {
    float* row = along.data() + lattice.index(0, b);
    const char* here = marked.data() + lattice.index(0, b);
    int since = far;
    for (int a = 0; a < w; ++a) {
      since = here[a] ? 0 : std::min(far, since + 1);
      row[a] = static_cast<float>(since);
      any[static_cast<std::size_t>(b)] |= here[a];
    }
    since = far;
    for (int a = w - 1; a >= 0; --a) {
      since = here[a] ? 0 : std::min(far, since + 1);
      const float nearer = std::min(row[a], static_cast<float>(since));
      row[a] = nearer * nearer;
    }
  }
  for (int b = 0; b < h; ++b) {
    if (!any[static_cast<std::size_t>(b)]) continue;
    const float* row = along.data() + lattice.index(0, b);
    for (int across = std::max(0, b - far); across <= std::min(h - 1, b + far); ++across) {
      float* to = squares.data() + lattice.index(0, across);
      const auto more = static_cast<float>((across - b) * (across - b));
      for (int a = 0; a < w; ++a) to[a] = std::min(to[a], row[a] + more);
    }
  }
  const auto step = static_cast<float>(lattice.step);
  for (float& square : squares) square = std::sqrt(square) * step;
  return squares;
}

}  // namespace sculpt
