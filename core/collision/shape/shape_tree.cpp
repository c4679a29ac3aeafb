#include "core/collision/shape/shape_tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <span>

namespace sculpt {
namespace {

constexpr std::size_t few_triangles = 4;  // they share the axes of the box around them

/// Halves the triangles of a mesh, box by box, down to single ones.
class MeshTree {
 public:
  MeshTree(const Mesh& mesh, const Frame& pose) {
    triangles_.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles)
      triangles_.push_back(Convex::triangle(pose * mesh.vertices[a], pose * mesh.vertices[b], pose * mesh.vertices[c]));
    centres_.reserve(triangles_.size());
    for (const Convex& triangle : triangles_) centres_.push_back(triangle.centre());
  }

  ShapeTree make() && {
    tree_.nodes.reserve(2 * triangles_.size());
    std::vector<std::size_t> all(triangles_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    tree_.nodes.emplace_back();
    fill(0, all, Eigen::Matrix3d::Identity());
    return std::move(tree_);
  }

 private:
  using Part = std::span<std::size_t>;

  void fill(std::size_t node, Part part, const Eigen::Matrix3d& axes) {
    if (part.size() == 1) {
      tree_.nodes[node].shape = triangles_[part.front()];
      return;
    }
    Convex box = box_around(part, axes);
    if (part.size() > few_triangles) {
      const Convex own = box_around(part, main_axes(part));
      if (surface(own) < surface(box)) box = own;
    }
    tree_.nodes[node].shape = box;
    const std::size_t low = halve(part, box);
    const std::size_t first = tree_.nodes.size();
    tree_.nodes[node].first_child = static_cast<int>(first);
    tree_.nodes[node].children = 2;
    tree_.nodes.resize(first + 2);
    fill(first, part.first(low), box.axes);
    fill(first + 1, part.subspan(low), box.axes);
  }

  template <typename Visit>
  void for_each_corner(Part part, const Visit& visit) const {
    for (const std::size_t t : part) {
      const Convex& triangle = triangles_[t];
      visit(triangle.middle);
      visit(Vec3(triangle.middle + triangle.axes.col(0)));
      visit(Vec3(triangle.middle + triangle.axes.col(1)));
    }
  }

  /// Of the corners' scatter.
  Eigen::Matrix3d main_axes(Part part) const {
    Vec3 sum = Vec3::Zero();
    for_each_corner(part, [&](const Vec3& corner) { sum += corner; });
    const Vec3 mean = sum / (3 * static_cast<double>(part.size()));
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for_each_corner(part, [&](const Vec3& corner) { scatter += (corner - mean) * (corner - mean).transpose(); });
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(scatter);
    const Vec3 first = solver.eigenvectors().col(2).stableNormalized();
    Vec3 second = solver.eigenvectors().col(1);
    second -= first * first.dot(second);
    if (!(first.norm() > 0.5 && second.norm() > 0.5)) return Eigen::Matrix3d::Identity();
    second.normalize();
    Eigen::Matrix3d axes;
    axes << first, second, first.cross(second);
    return axes;
  }

  Convex box_around(Part part, const Eigen::Matrix3d& axes) const {
    Eigen::AlignedBox3d box;
    for_each_corner(part, [&](const Vec3& corner) { box.extend(Vec3(axes.transpose() * corner)); });
    Frame pose = Frame::Identity();
    pose.linear() = axes;
    pose.translation() = axes * box.center();
    constexpr double rounding = 1e-12;
    return Convex::box(pose, box.sizes() / 2 * (1 + rounding) + Vec3::Constant(rounding));
  }

  static double surface(const Convex& box) {
    return box.half.x() * box.half.y() + box.half.y() * box.half.z() + box.half.z() * box.half.x();
  }

  /// Sorts the part into two along the box's longest side and says where the second begins.
  std::size_t halve(Part part, const Convex& box) const {
    Eigen::Index longest = 0;
    box.half.maxCoeff(&longest);
    const Vec3 axis = box.axes.col(longest);
    const double middle = axis.dot(box.middle);
    const auto second =
        std::stable_partition(part.begin(), part.end(), [&](std::size_t t) { return axis.dot(centres_[t]) < middle; });
    const auto low = static_cast<std::size_t>(second - part.begin());
    return low == 0 || low == part.size() ? part.size() / 2 : low;
  }

  std::vector<Convex> triangles_;
  std::vector<Vec3> centres_;
  ShapeTree tree_;
};

/// A capsule around it is quicker to ask.
ShapeTree make_cylinder_tree(const Shape& shape) {
  const Vec3 end(0, 0, shape.length_m / 2);
  return {{{Convex::capsule(shape.pose * Vec3(-end), shape.pose * end, shape.radius_m), 1, 1},
           {Convex::cylinder(shape.pose, shape.radius_m, shape.length_m / 2)}}};
}

}  // namespace

ShapeTree make_tree(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere:
      return {{{Convex::sphere(shape.pose.translation(), shape.radius_m)}}};
    case ShapeKind::box:
      return {{{Convex::box(shape.pose, shape.sides_m / 2)}}};
    case ShapeKind::cylinder:
      return make_cylinder_tree(shape);
    case ShapeKind::mesh:
      return MeshTree(*shape.mesh, shape.pose).make();
  }
  return {};
}

}  // namespace sculpt
