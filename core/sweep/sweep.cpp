#include "core/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/base/random.hpp"
#include "core/cell/ik.hpp"
#include "core/motion/random_configuration.hpp"
#include "core/motion/transit.hpp"
#include "core/sweep/follow.hpp"

namespace sculpt {
namespace {

constexpr int random_guesses = 24;
constexpr std::size_t most_fields = 3;
constexpr double probe_half = 0.03;  // rad or m: what the joints do within a cell of a field

class Sweep {
 public:
  Sweep(const Scene& scene, const VoxelGrid& voxels, const Configuration& home, std::uint64_t seed,
        const std::function<void(const Keyframe&)>& emit, const Watch& watch)
      : scene_(scene),
        voxels_(voxels),
        home_(home),
        seed_(seed),
        emit_(emit),
        watch_(watch),
        standing_(voxels.stock),
        q_(home),
        views_(tool_views(voxels.n())) {}

  VoxelSet run() {
    while (const auto view = best_view()) carve_along(*view);
    if (!transit(home_)) move(way_home());
    return standing_;
  }

 private:
  /// The direction along which most can be cut now, of those that are not used up.
  std::optional<std::size_t> best_view() {
    std::optional<std::size_t> best;
    std::uint64_t most = 0;
    for (std::size_t view = 0; view < views_.size(); ++view) {
      if (used_up_[view]) continue;
      if (!fields_[view]) fields_[view] = find_field(view);
      const std::uint64_t count = columns_of(view).count_cuttable();
      if (count <= most) continue;
      most = count;
      best = view;
    }
    return best;
  }

  Columns columns_of(std::size_t view) const {
    const PostureField* field = fields_[view].get();
    return {views_[view], standing_, voxels_.keep, [field](const Vec3& cell) { return field->usable(cell); }};
  }

  /// Configurations from which a field may grow: home, those of the other fields with one joint turned by quarters (a
  /// turntable makes one side of the stock of another), then random ones.
  std::vector<Configuration> find_guesses(std::size_t view) const {
    const Chain& chain = scene_.chain();
    std::vector<Configuration> guesses{home_};
    for (const auto& field : fields_) {
      if (!field) continue;
      for (Eigen::Index joint = 0; joint < home_.size(); ++joint)
        for (int quarters : {1, -1, 2, -2}) {
          Configuration guess = field->start();
          guess[joint] += quarters * std::numbers::pi / 2;
          if (chain.within_limits(guess)) guesses.push_back(guess);
        }
    }
    Random random(mix(seed_, view));
    for (int guess = 0; guess < random_guesses; ++guess) guesses.push_back(random_configuration(chain, random));
    return guesses;
  }

  /// At how many of some ball positions all over the grid the arm has room, if it comes there from `start`.
  int count_free_probes(const ToolView& view, const Configuration& start) const {
    const double last = voxels_.n() - 1;
    int free = 0;
    for (double a : {0.5, 0.05, 0.95})
      for (double b : {0.5, 0.05, 0.95}) {
        std::optional<Configuration> q = start;
        for (double c : {0.95, 0.5, 0.05}) {
          q = solve_ik(scene_.chain(), {view.ball_m(scene_.grid(), Vec3(a, b, c) * last), view.axis()}, *q);
          if (!q) break;
          free += !scene_.bubble(*q, Configuration::Constant(q->size(), probe_half)).empty();
        }
      }
    return free;
  }

  /// The field that covers most, of those that grow from the most promising starts.
  std::unique_ptr<PostureField> find_field(std::size_t which) const {
    const ToolView& view = views_[which];
    const double middle = (voxels_.n() - 1) / 2.0;
    const IkGoal above{view.ball_m(scene_.grid(), {middle, middle, voxels_.n() + 1.0}), view.axis()};
    struct Start {
      Configuration q;
      int free;
    };
    std::vector<Start> starts;
    for (const Configuration& guess : find_guesses(which)) {
      const auto q = solve_ik(scene_.chain(), above, guess);
      if (!q || scene_.contact_at(*q) != Contact::none) continue;
      const bool known = std::any_of(starts.begin(), starts.end(),
                                     [&](const Start& other) { return (*q - other.q).cwiseAbs().maxCoeff() < 0.3; });
      if (!known) starts.push_back({*q, count_free_probes(view, *q)});
    }
    std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.free > b.free; });
    std::unique_ptr<PostureField> best;
    for (std::size_t start = 0; start < std::min<std::size_t>(starts.size(), most_fields); ++start) {
      auto field = std::make_unique<PostureField>(scene_, view, starts[start].q, watch_);
      if (!best || field->usable_cells() > best->usable_cells()) best = std::move(field);
      if (20 * best->usable_cells() >= 17 * best->all_cells()) break;
    }
    if (best && 2 * best->usable_cells() > best->all_cells()) best->refine(scene_, watch_);
    return best ? std::move(best) : std::make_unique<PostureField>(scene_, view, home_, watch_);
  }

  /// Where the tool comes in: above the middle of the grid.
  Vec3 hub_cell() const {
    const int middle = voxels_.n() / 2;
    return Vec3(middle, middle, voxels_.n() + 1);
  }

  /// Cuts all that lies free along one direction, layer by layer.
  void carve_along(std::size_t which) {
    const std::uint64_t before = removed_;
    if (!enter(which)) {
      used_up_[which] = true;
      return;
    }
    Columns columns = columns_of(which);
    const Stray stray = stray_of(scene_.tool(), scene_.grid().voxel_m);
    for (int layer = voxels_.n() - 1; layer >= 0;) {
      Vec3 end = at_;
      const std::vector<Stroke> strokes = columns.cut_layer(layer, end, stray.ball);
      const std::size_t done = make(strokes);
      if (done == strokes.size()) {
        --layer;
        continue;
      }
      std::size_t failed = done;  // the cut that could not be come to or not be made
      while (strokes[failed].count == 0) ++failed;
      for (std::size_t s = strokes.size(); s-- > done;) columns.restore(strokes[s], s == failed);
    }
    Vec3 end = at_;
    const std::vector<Stroke> rise = columns.rise(end, stray.ball);
    if (make(rise) < rise.size()) throw std::logic_error("the tool came down where it cannot go up again");
    used_up_[which] = removed_ == before;
  }

  /// Goes over to the hub of another direction, remembering how to get home from there.
  bool enter(std::size_t which) {
    const auto hub = fields_[which]->at(hub_cell());
    if (!hub) return false;
    std::vector<Configuration> back = way_home();
    const Configuration from = q_;
    const Transit found = plan_transit(scene_, from, *hub, mix(seed_, ++transits_), watch_.stop);
    if (watch_.stop.stop_requested()) throw Cancelled{};
    if (found.path.empty()) return false;
    move({found.path.begin() + 1, found.path.end()});
    way_home_.assign(found.path.rbegin() + 1, found.path.rend());
    way_home_.insert(way_home_.end(), back.begin(), back.end());
    field_ = fields_[which].get();
    at_ = hub_cell();
    return true;
  }

  bool transit(const Configuration& to) {
    const Transit found = plan_transit(scene_, q_, to, mix(seed_, ++transits_), watch_.stop);
    if (watch_.stop.stop_requested()) throw Cancelled{};
    if (found.path.empty()) return false;
    move({found.path.begin() + 1, found.path.end()});
    return true;
  }

  /// From where the arm stands, above the material: over to the hub of the direction and from there as it came.
  std::vector<Configuration> way_home() const {
    if (field_ == nullptr) return {};
    const Followed over = follow(*field_, scene_.tool(), scene_.grid(), at_, {{hub_cell(), 0, 0, {}, {}}});
    if (at_ != hub_cell() && over.strokes == 0) throw std::logic_error("the arm cannot go back to its hub");
    std::vector<Configuration> way;
    for (const Keyframe& keyframe : over.keyframes) way.push_back(keyframe.q);
    way.insert(way.end(), way_home_.begin(), way_home_.end());
    return way;
  }

  void move(const std::vector<Configuration>& way) {
    for (const Configuration& q : way) {
      if (q == q_) continue;
      emit_({q, false, {}, {}});
      q_ = q;
    }
  }

  /// As many strokes as can be followed, from where the ball is; returns their number.
  std::size_t make(const std::vector<Stroke>& strokes) {
    const Followed followed = follow(*field_, scene_.tool(), scene_.grid(), at_, strokes);
    for (const Keyframe& keyframe : followed.keyframes) {
      emit_(keyframe);
      q_ = keyframe.q;
      if (keyframe.cut) remove(keyframe);
    }
    if (followed.strokes > 0) at_ = strokes[followed.strokes - 1].to;
    return followed.strokes;
  }

  void remove(const Keyframe& cut) {
    const int count = run_length(cut);
    const Voxel way = cut.last - cut.first;
    const Voxel step = count == 1 ? Voxel{} : Voxel{way.i / (count - 1), way.j / (count - 1), way.k / (count - 1)};
    for (int m = 0; m < count; ++m) standing_.erase(cut.first + step * m);
    removed_ += static_cast<std::uint64_t>(count);
  }

  const Scene& scene_;
  const VoxelGrid& voxels_;
  Configuration home_;
  std::uint64_t seed_, transits_ = 0, removed_ = 0;
  const std::function<void(const Keyframe&)>& emit_;
  const Watch& watch_;
  VoxelSet standing_;
  Configuration q_;
  Vec3 at_ = Vec3::Zero();               ///< the ball, in cells of the view of `field_`
  const PostureField* field_ = nullptr;  ///< of the direction in use; none at home
  std::vector<Configuration> way_home_;  ///< from the hub of that direction
  std::array<ToolView, 5> views_;
  std::array<std::unique_ptr<PostureField>, 5> fields_;
  std::array<bool, 5> used_up_{};
};

}  // namespace

VoxelSet carve_by_sweeps(const Scene& scene, const VoxelGrid& voxels, const Configuration& home, std::uint64_t seed,
                         const std::function<void(const Keyframe&)>& emit, const Watch& watch) {
  return Sweep(scene, voxels, home, seed, emit, watch).run();
}

}  // namespace sculpt
