#include "clients/cli/place/place_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "clients/cli/place/formatted.hpp"

namespace sculpt::cli {

namespace {

constexpr std::size_t max_maps = 24, maps_a_row = 3;
constexpr double cell_width = 52, cell_height = 26, left = 56, top = 44, gap = 24;  // pixels
constexpr double head = 76;                                                         // title and scale above all maps
constexpr double max_caption = 376;                                                 // of a map, in pixels
constexpr double min_left = 0.01, max_left = 100;                                   // % at the ends of the scale
constexpr std::array scale{0.0, 90.0, 99.0, 99.9, 99.99};                           // % reached

/// All of a stand but x and y.
using Rest = std::tuple<double, double, double, double>;
Rest rest_of(const Stand& stand) {
  return {stand.at_m.z(), stand.height_m, stand.stickout_m, stand.turn_rad};
}

using Colour = std::array<int, 3>;

/// From dark red over yellow to green: all is left to (next to) nothing is.
Colour colour_of(double reached) {
  const double left_percent = 100 - reached;
  constexpr std::array<std::array<double, 3>, 4> stops{{{165, 0, 38}, {244, 109, 67}, {254, 224, 139}, {26, 152, 80}}};
  const double share =
      std::log(std::clamp(left_percent, min_left, max_left) / max_left) / std::log(min_left / max_left);
  const double at = share * (stops.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double part = at - static_cast<double>(first);
  const auto mixed = [&](std::size_t channel) {
    return static_cast<int>(std::lround(stops[first][channel] * (1 - part) + stops[first + 1][channel] * part));
  };
  return {mixed(0), mixed(1), mixed(2)};
}

/// What can be read on it, by its luma (ITU-R BT.601).
const char* ink_on(const Colour& colour) {
  return 0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2] < 110 ? "white" : "black";
}

/// A share of what is to be removed, in its colour.
std::string box(double x, double y, double reached, int digits) {
  const Colour colour = colour_of(reached);
  return formatted(
      "<rect x=\"%.0f\" y=\"%.0f\" width=\"%.0f\" height=\"%.0f\" fill=\"#%02x%02x%02x\" stroke=\"white\"/>"
      "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\" fill=\"%s\">%.*f</text>\n",
      x, y, cell_width, cell_height, colour[0], colour[1], colour[2], x + cell_width / 2, y + 17, ink_on(colour),
      digits, reached);
}

std::string frame(double x, double y, const char* dashes) {
  return formatted(
      "<rect x=\"%.0f\" y=\"%.0f\" width=\"%.0f\" height=\"%.0f\" fill=\"none\" stroke=\"black\" "
      "stroke-width=\"2\" stroke-dasharray=\"%s\"/>\n",
      x + 1, y + 1, cell_width - 2, cell_height - 2, dashes);
}

constexpr const char* own_frame = "none";
constexpr const char* best_frame = "4 3";

/// What colours and frames mean.
std::string legend() {
  constexpr double y = 38, text_y = y + 17;
  std::string text;
  double x = 12;
  for (const double reached : scale) {
    text += box(x, y, reached, reached > 99 ? 2 : 0);
    x += cell_width;
  }
  for (const auto& [dashes, words] : {std::pair(own_frame, "as the cell stands"), std::pair(best_frame, "the best")}) {
    text += frame(x + 16, y, dashes) +
            formatted("<text x=\"%.0f\" y=\"%.0f\">%s</text>\n", x + cell_width + 24, text_y, words);
    x += cell_width + 130;
  }
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

class Maps {
 public:
  explicit Maps(const PlaceReport& report) : report_(report) {
    std::vector<Rest> best;  // of the maps, in order of their best stand
    for (const RatedStand& one : report.rated) {
      xs_.insert(one.stand.at_m.x());
      ys_.insert(one.stand.at_m.y());
      if (std::ranges::find(best, rest_of(one.stand)) == best.end()) best.push_back(rest_of(one.stand));
    }
    best.resize(std::min(best.size(), max_maps));
    for (const Rest& rest : best) maps_[rest];
    for (const RatedStand& one : report.rated)
      if (const auto at = maps_.find(rest_of(one.stand)); at != maps_.end()) at->second.push_back(&one);
  }

  std::string draw() const {
    const double width = std::max(left + cell_width * static_cast<double>(xs_.size()), max_caption) + gap;
    const double height = top + cell_height * static_cast<double>(ys_.size()) + gap;
    const std::size_t rows = (maps_.size() + maps_a_row - 1) / maps_a_row;
    const double columns = static_cast<double>(std::min(maps_.size(), maps_a_row));
    const double all_width = std::max(width * columns, 760.0), all_height = head + height * static_cast<double>(rows);
    std::string text = formatted(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
        "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
        all_width, all_height, all_width, all_height);
    text += "<text x=\"12\" y=\"24\" font-size=\"14\">" + escaped(report_.cell.name) +
            ": % of what is to be removed, at x " + "(across) and y (up) of joint '" +
            escaped(report_.cell.robot.joints[static_cast<std::size_t>(report_.joint)].name) + "' in m</text>\n" +
            legend();
    std::size_t number = 0;
    for (const auto& [rest, stands] : maps_) {
      text += formatted("<g transform=\"translate(%.0f %.0f)\">\n", width * static_cast<double>(number % maps_a_row),
                        head + height * static_cast<double>(number / maps_a_row));
      text += draw_one(rest, stands) + "</g>\n";
      ++number;
    }
    return text + "</svg>\n";
  }

 private:
  std::string draw_one(const Rest& rest, const std::vector<const RatedStand*>& stands) const {
    const auto [z, height, tool, turn] = rest;
    std::string text = formatted(
        "<text x=\"%.0f\" y=\"16\" font-weight=\"bold\">z %.3f m, block at %.3f m, tool %.3f m, turn %.0f°</text>\n",
        left, z, height, tool, turn * 180 / std::numbers::pi);
    for (const double x : xs_)
      text +=
          formatted("<text x=\"%.0f\" y=\"36\" text-anchor=\"middle\">%.3f</text>\n", column(x) + cell_width / 2, x);
    for (const double y : ys_)
      text += formatted("<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"end\">%.3f</text>\n", left - 6, row(y) + 17, y);
    std::string frames;
    for (const RatedStand* one : stands) {
      const double x = column(one->stand.at_m.x()), y = row(one->stand.at_m.y());
      const double reached = percent(one->share.held, one->share.removable);
      text += box(x, y, reached, 2);
      if (one->stand == report_.own)
        frames += frame(x, y, own_frame);
      else if (one == &report_.rated[report_.best])
        frames += frame(x, y, best_frame);
    }
    return text + frames;
  }

  double column(double x) const {
    return left + cell_width * static_cast<double>(std::distance(xs_.begin(), xs_.find(x)));
  }
  double row(double y) const {
    return top + cell_height * static_cast<double>(std::distance(ys_.find(y), ys_.end()) - 1);
  }

  const PlaceReport& report_;
  std::set<double> xs_, ys_;
  std::map<Rest, std::vector<const RatedStand*>> maps_;
};

}  // namespace

std::string place_map_svg(const PlaceReport& report) {
  return Maps(report).draw();
}

}  // namespace sculpt::cli
