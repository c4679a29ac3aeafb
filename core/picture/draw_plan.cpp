#include "core/picture/draw_plan.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/cell/link_poses.hpp"
#include "core/cell/milling/mounted_tool.hpp"

namespace sculpt {
namespace {

// Those of the page.
constexpr Colour raw{0x9a, 0x8f, 0x80}, cut{0xe9, 0xe2, 0xd4}, left_over{0xd1, 0x49, 0x5b}, body{0xb4, 0xbe, 0xc8},
    room{0xd6, 0xd8, 0xd8}, tool_colour{0xe0, 0xb0, 0x4a}, holder_colour{0x59, 0x63, 0x6e};
constexpr int reach = 2;           // a normal comes from the 5 x 5 x 5 voxels around
constexpr double margin = 1.04;    // around what is seen
constexpr double step_voxels = 4;  // a step of so many has an edge

struct Side {
  const char* name;
  Vec3 from;
};
const std::array<Side, 6> sides{{{"corner", {0.62, -0.85, 0.6}},
                                 {"front", {0, -1, 0}},
                                 {"back", {0, 1, 0}},
                                 {"left", {-1, 0, 0}},
                                 {"right", {1, 0, 0}},
                                 {"top", {0, 0, 1}}}};

View view_from(const std::string& side) {
  const auto found = std::ranges::find_if(sides, [&](const Side& one) { return side == one.name; });
  if (found == sides.end()) throw std::invalid_argument("a plan is not drawn from '" + side + "'");
  const Vec3 from = found->from.normalized();
  const Vec3 right = from.z() == 1 ? Vec3::UnitX() : Vec3(Vec3::UnitZ().cross(from).normalized());
  return {right, from.cross(right), Vec3::Zero(), 1, 0};
}

class PlanDrawing {
 public:
  PlanDrawing(const StockMoment& moment, const Cell* cell, const PlanPictureSettings& settings)
      : moment_(moment), view_(view_from(settings.side)), pixels_(settings.pixels) {
    if (cell != nullptr) add_cell(*cell);
    frame_picture();
  }

  Picture draw() {
    Canvas canvas(pixels_, pixels_, view_);
    for (const Facet& facet : facets_) canvas.draw(facet);
    const Vec3 eye = to_room_.linear().transpose() * view_.right.cross(view_.up);
    for_each_voxel(moment_.standing, [&](Voxel v) { draw_voxel(canvas, v, eye); });
    return canvas.finish();
  }

 private:
  void add_cell(const Cell& cell) {
    std::vector<double> values = cell.rest;
    for (std::size_t at = 0; at < moment_.header.joints.size(); ++at) {
      const int joint = cell.robot.find_joint(moment_.header.joints[at]);
      if (joint < 0)
        throw InputError("cell_invalid", "the plan moves a joint '" + moment_.header.joints[at] +
                                             "', which this cell has not: name the cell that it was planned for, '" +
                                             moment_.header.cell + "'");
      values[static_cast<std::size_t>(joint)] = moment_.q[static_cast<Eigen::Index>(at)];
    }
    follow_leaders(cell.robot, values);
    const std::vector<Frame> at = link_poses(cell.robot, values);
    for (std::size_t link = 0; link < at.size(); ++link)
      for (const Shape& shape : cell.robot.links[link].shapes)
        add_facets(shape, at[link], moves(cell.robot, static_cast<int>(link)) ? body : room, facets_);
    add_tool(cell, at[static_cast<std::size_t>(cell.tool_link)]);
    to_room_ = at[static_cast<std::size_t>(cell.stock_link)];
  }

  static bool moves(const Robot& robot, int link) {
    for (int joint; (joint = robot.links[static_cast<std::size_t>(link)].parent_joint) >= 0;) {
      const Joint& above = robot.joints[static_cast<std::size_t>(joint)];
      if (above.kind != JointKind::fixed) return true;
      link = above.parent_link;
    }
    return false;
  }

  void add_tool(const Cell& cell, const Frame& nose) {
    if (const auto& mill = moment_.header.mill) {
      const std::vector<Shape> shapes = tool_shapes(mill->tools[static_cast<std::size_t>(moment_.tool)]);
      for (const Shape& shape : shapes)
        add_facets(shape, nose, &shape == shapes.data() ? tool_colour : holder_colour, facets_);
      return;
    }
    const Tool& tool = moment_.header.tool;
    Shape ball, shank;
    ball.kind = ShapeKind::sphere;
    ball.radius_m = tool.ball_radius_m;
    ball.pose.translation().z() = tool.stickout_m;
    shank.kind = ShapeKind::cylinder;
    shank.radius_m = tool.shank_radius_m;
    shank.length_m = tool.stickout_m;
    shank.pose.translation().z() = tool.stickout_m / 2;
    add_facets(ball, nose, tool_colour, facets_);
    if (shank.length_m > 0) add_facets(shank, nose, tool_colour, facets_);
    for (const Shape& part : holder_shapes(cell.tool)) add_facets(part, nose, holder_colour, facets_);
  }

  /// The middle of all that is drawn, and how much of it the sides of the picture take.
  void frame_picture() {
    std::vector<Vec3> points;
    const double edge_m = moment_.header.grid.voxel_m * moment_.header.grid.n;
    for (int corner = 0; corner < 8; ++corner)
      points.push_back(to_room_ *
                       Vec3(moment_.header.grid.origin_m + edge_m * Vec3(corner & 1, corner >> 1 & 1, corner >> 2)));
    for (const Facet& facet : facets_)
      if (facet.colour != room) points.insert(points.end(), facet.corners.begin(), facet.corners.end());
    Eigen::AlignedBox3d box;  // in the directions of the picture
    for (const Vec3& point : points) box.extend(Vec3(view_.right.dot(point), view_.up.dot(point), 0));
    const Vec3 middle = box.center();
    view_.middle_m = middle.x() * view_.right + middle.y() * view_.up;
    view_.span_m = margin * box.sizes().maxCoeff();
    view_.edge_m = step_voxels * moment_.header.grid.voxel_m;
  }

  bool stands(Voxel v) const { return moment_.header.grid.contains(v) && moment_.standing.contains(v); }
  bool stood(Voxel v) const { return moment_.header.grid.contains(v) && moment_.start.stock.contains(v); }

  /// Away from what stands around; zero where there is as much on each side.
  Vec3 smooth_normal(Voxel v) const {
    Voxel sum;
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          if (stands(v + Voxel{i, j, k})) sum = sum - Voxel{i, j, k};
    return {static_cast<double>(sum.i), static_cast<double>(sum.j), static_cast<double>(sum.k)};
  }

  /// The faces that are open and turned to the eye, a direction in the stock's frame.
  void draw_voxel(Canvas& canvas, Voxel v, const Vec3& eye) const {
    Vec3 normal = Vec3::Zero();
    for (const Voxel step : face_steps) {
      const Vec3 out(step.i, step.j, step.k);
      if (out.dot(eye) <= 1e-9 || stands(v + step)) continue;
      if (normal.isZero()) normal = smooth_normal(v);
      const Colour colour = moment_.left.contains(v) ? left_over : stood(v + step) ? cut : raw;
      draw_face(canvas, v, out, {normal.isZero() ? out : Vec3(normal.normalized()), colour});
    }
  }

  struct Look {
    Vec3 normal;
    Colour colour;
  };
  void draw_face(Canvas& canvas, Voxel v, const Vec3& out, const Look& look) const {
    const double half_m = moment_.header.grid.voxel_m / 2;
    const Vec3 u = half_m * Vec3(out.y(), out.z(), out.x()), w = half_m * Vec3(out.z(), out.x(), out.y()),
               middle = moment_.header.grid.centre(v) + half_m * out;
    const Vec3 a = to_room_ * (middle - u - w), b = to_room_ * (middle + u - w), c = to_room_ * (middle + u + w),
               d = to_room_ * (middle - u + w);
    const Vec3 normal = to_room_.linear() * look.normal;
    canvas.draw({{a, b, c}, look.colour, normal});
    canvas.draw({{a, c, d}, look.colour, normal});
  }

  const StockMoment& moment_;
  View view_;
  int pixels_;
  Frame to_room_ = Frame::Identity();  ///< from the stock's frame
  std::vector<Facet> facets_;          ///< of the cell
};

}  // namespace

const std::vector<std::string>& picture_sides() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Side& side : sides) all.emplace_back(side.name);
    return all;
  }();
  return names;
}

Picture draw_plan(const StockMoment& moment, const Cell* cell, const PlanPictureSettings& settings) {
  return PlanDrawing(moment, cell, settings).draw();
}

}  // namespace sculpt
