#include "core/sweep/directions.hpp"

#include <algorithm>
#include <numbers>

#include "core/base/helpers.hpp"
#include "core/base/random.hpp"
#include "core/cell/ik.hpp"
#include "core/sweep/field/find_field.hpp"

namespace sculpt {
namespace {

constexpr std::size_t first_side = 1;  // of the views; four each of a kind follow

}  // namespace

Directions::Directions(const Scene& scene, const Configuration& home, const RunContext& run)
    : scene_(scene), home_(home), run_(run), turn_(find_stock_turn(scene.chain(), scene.grid())) {
  const int n = scene.grid().n;
  for (const ToolView& view : tool_views(n)) views_.push_back(view);
  straight_ = views_.size();
  for (const ToolView& view : tilted_views(n)) views_.push_back(view);
  fields_.resize(views_.size());
  reach_.resize(straight_);
}

void Directions::find_straight_fields() {
  const std::size_t apart = turn_ ? first_side + 1 : straight_;
  run_.helpers.for_each_index(apart, [&](std::size_t direction) { find(direction); });
  for (std::size_t direction = apart; direction < straight_; ++direction) find(direction);
  run_.helpers.for_each_index(straight_, [&](std::size_t direction) {
    const PostureField& field = *fields_[direction];
    reach_[direction].emplace(
        scene_.grid().n, [&](const Vec3& cell) { return field.part(cell); },
        [&](Voxel part) { return field.usable_part(part); });
  });
}

const PostureField& Directions::field(std::size_t direction) {
  find(direction);
  return *fields_[direction];
}

std::vector<std::size_t> Directions::tilted_found() const {
  std::vector<std::size_t> found;
  for (std::size_t direction = straight_; direction < fields_.size(); ++direction)
    if (fields_[direction]) found.push_back(direction);
  return found;
}

std::size_t Directions::number_of(const PostureField& field) const {
  const auto is_it = [&](const std::unique_ptr<PostureField>& other) { return other.get() == &field; };
  return static_cast<std::size_t>(std::ranges::find_if(fields_, is_it) - fields_.begin());
}

/// The first of each four sides that are quarter turns of each other is searched for. It is turned into the others', if
/// the stock can be.
void Directions::find(std::size_t direction) {
  if (fields_[direction]) return;
  const std::size_t quarters = direction < first_side ? 0 : (direction - first_side) % 4;
  if (turn_ && quarters > 0) {
    find(direction - quarters);
    fields_[direction] = turned(*fields_[direction - quarters], direction, static_cast<double>(quarters));
  }
  if (!fields_[direction]) fields_[direction] = search(direction);
}

std::unique_ptr<PostureField> Directions::search(std::size_t direction) const {
  // Held as from home above the stock, with some joint turned, the arm may well come from another side.
  std::vector<Configuration> known;
  const IkGoal hub{views_[0].ball_m(scene_.grid(), hub_cell(scene_.grid().n)), views_[0].axis()};
  if (const auto above = solve_ik(scene_.chain(), hub, home_); above && direction > 0) known.push_back(*above);
  return find_field(scene_, views_[direction], home_, known, {mix(run_.seed, direction), run_.helpers, run_.watch});
}

/// Nothing if the joint does not turn so far.
std::unique_ptr<PostureField> Directions::turned(const PostureField& field, std::size_t direction,
                                                 double quarters) const {
  for (double rounds : {0, -1, 1}) {
    const double by = turn_->direction * (quarters / 4 + rounds) * 2 * std::numbers::pi;
    if (field.can_turn(turn_->coordinate, by))
      return std::make_unique<PostureField>(field, views_[direction],
                                            by * Configuration::Unit(scene_.chain().dof(), turn_->coordinate));
  }
  return nullptr;
}

}  // namespace sculpt
