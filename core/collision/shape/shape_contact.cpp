#include "core/collision/shape/shape_contact.hpp"

#include <algorithm>
#include <utility>

#include "core/base/random.hpp"
#include "core/collision/shape/motion_bound.hpp"

namespace sculpt {
namespace {

constexpr int max_boxes = 4000, points_a_line = 65, points_a_side = 17, random_points = 1000, max_climbs = 200;
constexpr double centres_weight = 1e-3;  // of the distance of the centres, where nothing else tells up from down

Eigen::AlignedBox3d box_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

Vec3 half_sides_of(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere:
      return Vec3::Constant(shape.radius_m);
    case ShapeKind::cylinder:
      return {shape.radius_m, shape.radius_m, shape.length_m / 2};
    case ShapeKind::box:
      return shape.sides_m / 2;
    case ShapeKind::mesh:
      return box_of(*shape.mesh).sizes() / 2;
  }
  return Vec3::Zero();
}

Configuration share(const Chain& chain, Configuration q, int coordinate, double part) {
  q[coordinate] = chain.lower()[coordinate] + part * (chain.upper()[coordinate] - chain.lower()[coordinate]);
  return q;
}

}  // namespace

LinkShape::LinkShape(int of_link, const Shape& of_shape)
    : link(of_link),
      shape(&of_shape),
      geometry(make_fcl_geometry(of_shape, 0)),
      box(of_shape.pose),
      half_sides(half_sides_of(of_shape)) {
  if (of_shape.kind == ShapeKind::mesh) box.translate(Vec3(box_of(*of_shape.mesh).center()));
}

ShapeContact::ShapeContact(const Chain& chain, const LinkShape& first, const LinkShape& second)
    : chain_(chain), first_(&first), second_(&second) {
  if (first.shape->kind == ShapeKind::mesh) std::swap(first_, second_);
  thickness_m_ = first_->shape->kind == ShapeKind::mesh ? 0 : first_->half_thickness();
  speed_ = motion_bound(chain, second_->link, first_->link, first_->extent());
  for (int coordinate = 0; coordinate < chain.dof(); ++coordinate)
    if (speed_[coordinate] > 0) coordinates_.push_back(coordinate);
}

bool ShapeContact::touch(const Configuration& q, double reach_m) const {
  std::vector<Frame> at;
  chain_.link_poses(q, at);
  const Frame& first = at[static_cast<std::size_t>(first_->link)];
  const Frame& second = at[static_cast<std::size_t>(second_->link)];
  const double between = (first * first_->box.translation() - second * second_->box.translation()).norm();
  if (between > first_->half_sides.norm() + second_->half_sides.norm() + reach_m) return false;
  const Frame first_pose = to_fcl(first * first_->shape->pose), second_pose = to_fcl(second * second_->shape->pose);
  if (first_->shape->kind == ShapeKind::mesh)
    return fcl_touch(*first_->geometry, first_pose, *second_->geometry, second_pose) ||
           fcl_distance_mm(*first_->geometry, first_pose, *second_->geometry, second_pose) <= fcl_mm * reach_m;
  return fcl_touch(*make_fcl_geometry(*first_->shape, reach_m), first_pose, *second_->geometry, second_pose);
}

bool ShapeContact::always_touch(const Configuration& q) const {
  if (thickness_m_ == 0) return false;
  Configuration low = q, high = q;
  for (int coordinate : coordinates_) {
    low[coordinate] = chain_.lower()[coordinate];
    high[coordinate] = chain_.upper()[coordinate];
  }
  int boxes_left = max_boxes;
  return covered(low, high, boxes_left);
}

bool ShapeContact::covered(const Configuration& low, const Configuration& high, int& boxes_left) const {
  const Configuration middle = (low + high) / 2, half = (high - low) / 2;
  if (boxes_left-- <= 0 || !touch(middle)) return false;
  const double motion = speed_.dot(half) + touching_m;
  if (motion < thickness_m_ && touch(middle, -motion)) return true;
  Eigen::Index widest = 0;
  speed_.cwiseProduct(half).maxCoeff(&widest);
  Configuration below = high, above = low;
  below[widest] = above[widest] = middle[widest];
  return covered(low, below, boxes_left) && covered(above, high, boxes_left);
}

/// Rises on the way to where they do not touch: less how deep the first one is in the second (m).
double ShapeContact::apartness(const Configuration& q) const {
  double touches = 0, does_not = thickness_m_;
  for (int step = 0; thickness_m_ > 0 && step < 8; ++step) {
    const double middle = (touches + does_not) / 2;
    (touch(q, -middle) ? touches : does_not) = middle;
  }
  std::vector<Frame> at;
  chain_.link_poses(q, at);
  const Vec3 first = at[static_cast<std::size_t>(first_->link)] * first_->box.translation();
  const Vec3 second = at[static_cast<std::size_t>(second_->link)] * second_->box.translation();
  return centres_weight * (first - second).norm() - touches;
}

bool ShapeContact::climb(Configuration q) const {
  double best = apartness(q), step = 0.1;
  for (int left = max_climbs; left > 0 && step > 1e-3; --left) {
    Configuration next = q;
    for (int coordinate : coordinates_)
      for (double way : {-step, step}) {
        Configuration tried = q;
        tried[coordinate] += way * (chain_.upper()[coordinate] - chain_.lower()[coordinate]);
        tried = tried.cwiseMax(chain_.lower()).cwiseMin(chain_.upper());
        if (!touch(tried)) return true;
        if (const double here = apartness(tried); here > best) {
          best = here;
          next = tried;
        }
      }
    if (next == q) step /= 2;
    q = next;
  }
  return false;
}

bool ShapeContact::come_apart(const Configuration& q) const {
  const auto part = [](int point, int points) { return static_cast<double>(point) / (points - 1); };
  for (int coordinate : coordinates_)
    for (int point = 0; point < points_a_line; ++point)
      if (!touch(share(chain_, q, coordinate, part(point, points_a_line)))) return true;
  for (int first : coordinates_)
    for (int second : coordinates_)
      for (int at = 0; first < second && at < points_a_side * points_a_side; ++at)
        if (!touch(share(chain_, share(chain_, q, first, part(at % points_a_side, points_a_side)), second,
                         part(at / points_a_side, points_a_side))))
          return true;
  Random random(1);
  Configuration best = q;
  double most = apartness(q);
  for (int point = 0; point < random_points; ++point) {
    Configuration tried = q;
    for (int coordinate : coordinates_) tried = share(chain_, tried, coordinate, random.unit());
    if (!touch(tried)) return true;
    if (const double here = apartness(tried); here > most) {
      most = here;
      best = tried;
    }
  }
  return climb(best) || climb(q);
}

}  // namespace sculpt
