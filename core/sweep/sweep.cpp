#include "core/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/parallel.hpp"
#include "core/base/random.hpp"
#include "core/motion/transit.hpp"
#include "core/sweep/find_field.hpp"
#include "core/sweep/follow.hpp"
#include "core/sweep/stock_turn.hpp"

namespace sculpt {
namespace {

constexpr std::size_t most_layers_at_once = 16;
constexpr std::size_t first_side = 1;  // among the views

class Sweep {
 public:
  Sweep(const Scene& scene, const VoxelGrid& voxels, const Configuration& home, std::uint64_t seed, int threads,
        const std::function<void(std::vector<Keyframe>)>& emit, const Watch& watch)
      : scene_(scene),
        voxels_(voxels),
        home_(home),
        seed_(seed),
        threads_(threads),
        emit_(emit),
        watch_(watch),
        standing_(voxels.stock),
        q_(home),
        views_(tool_views(voxels.n())) {}

  VoxelSet run() {
    find_fields();
    while (const auto view = best_view()) carve_along(*view);
    if (transit(home_)) return standing_;
    const auto way = way_home();
    if (!way)
      throw InputError("no_transit",
                       "the arm finds no way home from above the stock: keep what stands beside it lower");
    move(*way);
    return standing_;
  }

 private:
  /// One after the other: the starts for the top and a side help to find the others, or the side is turned into them.
  void find_fields() {
    const auto turn = find_stock_turn(scene_.chain(), scene_.grid());
    std::vector<Configuration> known;
    for (std::size_t view = 0; view < fields_.size(); ++view) {
      if (turn && view > first_side) fields_[view] = turn_side(*turn, view);
      if (fields_[view]) continue;
      fields_[view] = find_field(scene_, views_[view], home_, known, mix(seed_, view), threads_, watch_);
      if (view <= first_side) known.push_back(fields_[view]->start());
    }
    for_each_index(threads_, fields_.size(), [&](std::size_t view) {
      const PostureField& field = *fields_[view];
      reach_[view].emplace(
          voxels_.n(), [&](const Vec3& cell) { return field.usable(cell); },
          [&](const Vec3& cell) { return field.part(cell); });
    });
  }

  /// The first side's field for another side; nothing if the joint does not turn so far.
  std::unique_ptr<PostureField> turn_side(const StockTurn& stock, std::size_t view) const {
    const PostureField& side = *fields_[first_side];
    const auto quarters = static_cast<double>(view - first_side);
    for (double rounds : {0, -1, 1}) {
      const double by = stock.direction * (quarters / 4 + rounds) * 2 * std::numbers::pi;
      if (side.can_turn(stock.coordinate, by))
        return std::make_unique<PostureField>(side, views_[view],
                                              by * Configuration::Unit(scene_.chain().dof(), stock.coordinate));
    }
    return nullptr;
  }

  /// The direction along which most can be cut now, of those that are not used up.
  std::optional<std::size_t> best_view() const {
    std::array<std::uint64_t, 5> counts{};
    for_each_index(threads_, views_.size(), [&](std::size_t view) {
      if (!used_up_[view]) counts[view] = columns_of(view).count_cuttable();
    });
    const auto most = std::max_element(counts.begin(), counts.end());
    if (*most == 0) return std::nullopt;
    return static_cast<std::size_t>(most - counts.begin());
  }

  Columns columns_of(std::size_t view) const { return {views_[view], standing_, voxels_.keep, *reach_[view]}; }

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
    const double stray = stray_of(scene_.tool(), scene_.grid().voxel_m).ball;
    std::size_t at_once = most_layers_at_once;
    for (int layer = voxels_.n() - 1; layer >= 0;) {
      std::vector<Layer> layers = plan_layers(columns, layer, at_once, stray);
      for_each_index(threads_, layers.size(), [&](std::size_t at) {
        layers[at].followed = follow(*field_, scene_.tool(), scene_.grid(), layers[at].from, layers[at].strokes);
      });
      const int next = commit(layers, columns);
      // Where one cut fails others do, and each time the rest was planned in vain.
      at_once = next == layers.back().c - 1 ? std::min(2 * at_once, most_layers_at_once) : 1;
      layer = next;
    }
    Vec3 end = at_;
    const std::vector<Stroke> rise = columns.rise(end, stray);
    Followed up = follow(*field_, scene_.tool(), scene_.grid(), at_, rise);
    if (commit(std::move(up), rise) < rise.size())
      throw std::logic_error("the tool came down where it cannot go up again");
    used_up_[which] = removed_ == before;
  }

  struct Layer {
    int c;
    Vec3 from;
    std::vector<Stroke> strokes;
    Followed followed;
  };

  /// What is to be done in the next layers from `c` down, as if nothing failed. Their number is the same at any number
  /// of threads.
  std::vector<Layer> plan_layers(Columns& columns, int c, std::size_t at_once, double stray) const {
    std::vector<Layer> layers;
    Vec3 end = at_;
    for (; c >= 0 && layers.size() < at_once; --c) {
      const Vec3 from = end;
      layers.push_back({c, from, columns.cut_layer(c, end, stray), {}});
    }
    return layers;
  }

  /// Emits what could be followed, takes back what comes after a failure, and returns the layer to go on with.
  int commit(std::vector<Layer>& layers, Columns& columns) {
    for (std::size_t at = 0; at < layers.size(); ++at) {
      const auto& strokes = layers[at].strokes;
      const std::size_t done = commit(std::move(layers[at].followed), strokes);
      if (done == strokes.size()) continue;
      for (std::size_t later = layers.size(); later-- > at + 1;) take_back(layers[later].strokes, 0, columns, false);
      take_back(strokes, done, columns, true);
      return layers[at].c;
    }
    return layers.back().c - 1;
  }

  /// Of a failed layer the first cut that could not be come to or not be made is given up.
  static void take_back(const std::vector<Stroke>& strokes, std::size_t from, Columns& columns, bool failed) {
    std::size_t given_up = failed ? from : strokes.size();
    while (given_up < strokes.size() && strokes[given_up].count == 0) ++given_up;
    for (std::size_t s = strokes.size(); s-- > from;) columns.restore(strokes[s], s == given_up);
  }

  /// Goes over to the hub of another direction, remembering how to get home from there.
  bool enter(std::size_t which) {
    const auto hub = fields_[which]->at(hub_cell());
    if (!hub) return false;
    const auto back = way_home();
    if (!back) return false;
    const Configuration from = q_;
    const Transit found = plan_transit(scene_, from, *hub, mix(seed_, ++transits_), watch_.stop);
    if (watch_.stop.stop_requested()) throw Cancelled{};
    if (found.path.empty()) return false;
    move({found.path.begin() + 1, found.path.end()});
    way_home_.assign(found.path.rbegin() + 1, found.path.rend());
    way_home_.insert(way_home_.end(), back->begin(), back->end());
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

  /// From where the arm stands, above the material: over to the hub of the direction and from there as it came. Nothing
  /// if something stands between it and the hub.
  std::optional<std::vector<Configuration>> way_home() const {
    if (field_ == nullptr) return std::vector<Configuration>{};
    const Followed over = follow(*field_, scene_.tool(), scene_.grid(), at_, {{hub_cell(), 0, 0, {}, {}}});
    if (at_ != hub_cell() && over.strokes == 0) return std::nullopt;
    std::vector<Configuration> way;
    for (const Keyframe& keyframe : over.keyframes) way.push_back(keyframe.q);
    way.insert(way.end(), way_home_.begin(), way_home_.end());
    return way;
  }

  void move(const std::vector<Configuration>& way) {
    std::vector<Keyframe> keyframes;
    for (const Configuration& q : way) {
      if (q == q_) continue;
      keyframes.push_back({q, false, {}, {}});
      q_ = q;
    }
    emit(std::move(keyframes));
  }

  std::size_t commit(Followed followed, const std::vector<Stroke>& strokes) {
    for (const Keyframe& keyframe : followed.keyframes) {
      if (!keyframe.cut) continue;
      standing_.erase(keyframe.first, keyframe.last);
      removed_ += static_cast<std::uint64_t>(run_length(keyframe));
    }
    if (!followed.keyframes.empty()) q_ = followed.keyframes.back().q;
    if (followed.strokes > 0) at_ = strokes[followed.strokes - 1].to;
    emit(std::move(followed.keyframes));
    return followed.strokes;
  }

  void emit(std::vector<Keyframe> keyframes) const {
    if (!keyframes.empty()) emit_(std::move(keyframes));
  }

  const Scene& scene_;
  const VoxelGrid& voxels_;
  Configuration home_;
  std::uint64_t seed_, transits_ = 0, removed_ = 0;
  int threads_;
  const std::function<void(std::vector<Keyframe>)>& emit_;
  const Watch& watch_;
  VoxelSet standing_;
  Configuration q_;
  Vec3 at_ = Vec3::Zero();               ///< the ball, in cells of the view of `field_`
  const PostureField* field_ = nullptr;  ///< of the direction in use; none at home
  std::vector<Configuration> way_home_;  ///< from the hub of that direction
  std::array<ToolView, 5> views_;
  std::array<std::unique_ptr<PostureField>, 5> fields_;
  std::array<std::optional<ReachRows>, 5> reach_;  ///< where each field is usable
  std::array<bool, 5> used_up_{};
};

}  // namespace

VoxelSet carve_by_sweeps(const Scene& scene, const VoxelGrid& voxels, const Configuration& home, std::uint64_t seed,
                         int threads, const std::function<void(std::vector<Keyframe>)>& emit, const Watch& watch) {
  return Sweep(scene, voxels, home, seed, threads, emit, watch).run();
}

}  // namespace sculpt
