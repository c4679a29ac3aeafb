#include "core/doctor/draw_cell.hpp"

#include <algorithm>

#include "core/cell/link_poses.hpp"
#include "core/collision/link_pairs.hpp"

namespace sculpt {
namespace {

constexpr Colour red{225, 45, 40}, pale_red{238, 150, 140}, wood{222, 184, 120}, steel{90, 95, 105},
    floor_grey{205, 205, 200}, table_grey{150, 160, 165};
constexpr std::array<Colour, 4> arm_colours{{{120, 150, 190}, {165, 185, 210}, {100, 130, 175}, {185, 200, 218}}};
constexpr std::array<Colour, 3> axis_colours{{{200, 30, 30}, {20, 140, 40}, {30, 60, 200}}};
constexpr double tool_of_span = 0.006, axis_of_stock = 1.3, letter_of_span = 0.02, margin = 1.08;

/// Strokes of X, Y and Z in a square from -1 to 1.
const std::array<std::vector<std::array<double, 4>>, 3> letters{{{{-1, -1, 1, 1}, {-1, 1, 1, -1}},
                                                                 {{-1, 1, 0, 0}, {1, 1, 0, 0}, {0, 0, 0, -1}},
                                                                 {{-1, 1, 1, 1}, {1, 1, -1, -1}, {-1, -1, 1, -1}}}};

class CellDrawing {
 public:
  CellDrawing(const Cell& cell, const Configuration& q, const std::vector<NearBodies>& blocking)
      : cell_(cell), at_(link_poses(cell.robot, cell.chain().joint_values(q))), group_(rigid_groups(cell.robot)) {
    for (const NearBodies& pair : blocking)
      for (const int body : {pair.first, pair.second}) blocking_.push_back(body);
    find_bounds();
    add_links();
    add_stock();
    add_tool();
  }

  Picture draw(int height) const {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const Vec3 across = (x + y).normalized();  // seen from x > 0, y < 0
    const Vec3 eye = (Vec3(1, -1, 0).normalized() + 0.6 * z).normalized();
    std::vector<Picture> panels;
    for (const auto& [right, up] : {std::pair{across, Vec3(eye.cross(across))}, {x, z}, {x, y}})
      panels.push_back(draw_panel({right, up, box_.center(), span_m_, 0}, height));
    return side_by_side(panels);
  }

 private:
  bool blocks(int body) const { return std::find(blocking_.begin(), blocking_.end(), body) != blocking_.end(); }
  bool stands_still(std::size_t link) const {
    return group_[link] == group_[static_cast<std::size_t>(cell_.robot.root)];
  }

  /// Around all that matters: what moves, the stock, the tool, and what stands still but a large floor or wall.
  void find_bounds() {
    std::vector<Facet> all;
    for (std::size_t link = 0; link < at_.size(); ++link)
      if (!stands_still(link))
        for (const Shape& shape : cell_.robot.links[link].shapes) add_facets(shape, at_[link], {}, all);
    for (const Facet& facet : all)
      for (const Vec3& corner : facet.corners) box_.extend(corner);
    for (const double share : {0.0, 1.0})
      box_.extend(stock_pose() * Vec3(cell_.stock_origin_m + Vec3::Constant(share * cell_.stock_size_m)));
    box_.extend(at_[static_cast<std::size_t>(cell_.tool_link)] * Vec3(0, 0, cell_.tool.stickout_m));
    for (const Frame& link : at_) box_.extend(link.translation());
    const double max_body_m = 1.2 * box_.sizes().maxCoeff();
    for (std::size_t link = 0; link < at_.size(); ++link)
      for (const Shape& shape : cell_.robot.links[link].shapes) {
        std::vector<Facet> facets;
        if (stands_still(link)) add_facets(shape, at_[link], {}, facets);
        Eigen::AlignedBox3d box;
        for (const Facet& facet : facets)
          for (const Vec3& corner : facet.corners) box.extend(corner);
        if (!facets.empty() && box.sizes().maxCoeff() < max_body_m) box_.extend(box);
      }
    span_m_ = margin * std::max(box_.sizes().norm() * 0.85, box_.sizes().maxCoeff());
  }

  const Frame& stock_pose() const { return at_[static_cast<std::size_t>(cell_.stock_link)]; }

  void add_links() {
    std::size_t moving = 0;
    for (std::size_t link = 0; link < at_.size(); ++link) {
      const Link& source = cell_.robot.links[link];
      if (source.shapes.empty()) continue;
      const bool of_stock = group_[link] == group_[static_cast<std::size_t>(cell_.stock_link)];
      Colour colour = stands_still(link) ? floor_grey
                      : of_stock         ? table_grey
                                         : arm_colours[moving++ % arm_colours.size()];
      if (blocks(static_cast<int>(link))) colour = stands_still(link) ? pale_red : red;  // a floor is large
      for (const Shape& shape : source.shapes) add_facets(shape, at_[link], colour, facets_);
    }
  }

  void add_stock() {
    Shape cube;
    cube.sides_m = Vec3::Constant(cell_.stock_size_m);
    cube.pose.translation() = cell_.stock_origin_m + cube.sides_m / 2;
    add_facets(cube, stock_pose(), blocks(NearBodies::stock) ? red : wood, facets_);
  }

  void add_tool() {
    const Colour colour = blocks(NearBodies::tool) ? red : steel;
    const Frame& nose = at_[static_cast<std::size_t>(cell_.tool_link)];
    const double min_m = tool_of_span * span_m_;
    const auto in_metres = [&](double radius) {
      return cell_.tool.in_voxels ? radius * cell_.stock_size_m / 64 : radius;
    };
    Shape shank, ball;
    shank.kind = ShapeKind::cylinder;
    shank.length_m = cell_.tool.stickout_m;
    shank.radius_m = std::max(min_m, in_metres(cell_.tool.shank_radius));
    shank.pose.translation().z() = shank.length_m / 2;
    ball.kind = ShapeKind::sphere;
    ball.radius_m = std::max(1.4 * min_m, in_metres(cell_.tool.ball_radius));
    ball.pose.translation().z() = shank.length_m;
    if (shank.length_m > 0) add_facets(shank, nose, colour, facets_);
    add_facets(ball, nose, colour, facets_);
  }

  void draw_axes(Canvas& canvas, const View& view) const {
    const double length_m = axis_of_stock * cell_.stock_size_m, lift_m = 10 * span_m_,
                 letter_m = letter_of_span * span_m_;
    const Vec3 corner = stock_pose() * cell_.stock_origin_m;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 way = stock_pose().linear() * Vec3::Unit(axis);
      const auto a = static_cast<std::size_t>(axis);
      if (std::abs(way.dot(view.right)) < 1e-3 && std::abs(way.dot(view.up)) < 1e-3) continue;  // seen end on
      canvas.draw_line(corner, corner + length_m * way, axis_colours[a], lift_m);
      const Vec3 middle = corner + (length_m + 2 * letter_m) * way;
      for (const auto& [x0, y0, x1, y1] : letters[a])
        canvas.draw_line(middle + letter_m * (0.7 * x0 * view.right + y0 * view.up),
                         middle + letter_m * (0.7 * x1 * view.right + y1 * view.up), axis_colours[a], lift_m);
    }
  }

  Picture draw_panel(const View& view, int height) const {
    Canvas canvas(height, height, view);
    for (const Facet& facet : facets_) canvas.draw(facet);
    draw_axes(canvas, view);
    return canvas.finish();
  }

  static Picture side_by_side(const std::vector<Picture>& panels) {
    Picture all{0, panels.front().height, {}};
    for (const Picture& panel : panels) all.width += panel.width;
    for (int y = 0; y < all.height; ++y)
      for (const Picture& panel : panels) {
        const auto row = panel.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(y) * panel.width;
        all.rgb.insert(all.rgb.end(), row, row + 3 * static_cast<std::ptrdiff_t>(panel.width));
      }
    return all;
  }

  const Cell& cell_;
  const std::vector<Frame> at_;  // links in the room
  const std::vector<int> group_;
  std::vector<int> blocking_;
  Eigen::AlignedBox3d box_;
  double span_m_ = 1;
  std::vector<Facet> facets_;
};

}  // namespace

Picture draw_cell(const Cell& cell, const Configuration& q, const std::vector<NearBodies>& blocking, int height) {
  return CellDrawing(cell, q, blocking).draw(height);
}

}  // namespace sculpt
