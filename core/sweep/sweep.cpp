#include "core/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/parallel.hpp"
#include "core/base/random.hpp"
#include "core/material/support.hpp"
#include "core/motion/transit.hpp"
#include "core/sweep/find_field.hpp"
#include "core/sweep/follow.hpp"

namespace sculpt {
namespace {

constexpr std::size_t most_layers_at_once = 16;

/// Voxels number `first` to `last` of a cut that comes from `start`.
Stroke part_of(const Stroke& cut, const Vec3& start, int first, int last) {
  const Voxel way = cut.last - cut.first;
  const int steps = std::max(1, cut.count - 1);
  const Voxel step{way.i / steps, way.j / steps, way.k / steps};
  const Vec3 along = (cut.to - start) / cut.count;
  return {start + along * (last + 1), last + 1 - first, cut.stray, cut.first + step * first, cut.first + step * last};
}

class Sweep {
 public:
  Sweep(const Scene& scene, const VoxelGrid& voxels, const Configuration& home, std::uint64_t seed, int threads,
        const std::function<void(const Keyframe&)>& emit, const Watch& watch)
      : scene_(scene),
        voxels_(voxels),
        home_(home),
        seed_(seed),
        threads_(threads),
        emit_(emit),
        watch_(watch),
        support_(voxels.stock, find_unheld(voxels)),
        q_(home),
        views_(tool_views(voxels.n())) {}

  VoxelSet run() {
    find_fields();
    while (const auto view = best_view()) carve_along(*view);
    if (transit(home_)) return support_.standing();
    const auto way = way_home();
    if (!way)
      throw InputError("no_transit",
                       "the arm finds no way home from above the stock: keep what stands beside it lower");
    move(*way);
    return support_.standing();
  }

 private:
  /// One field after the other for the first direction, whose start helps the others; those at the same time.
  void find_fields() {
    fields_[0] = find_field(scene_, views_[0], home_, {}, mix(seed_, 0), watch_);
    const std::vector<Configuration> known{fields_[0]->start()};
    for_each_index(threads_, fields_.size() - 1, [&](std::size_t other) {
      const std::size_t view = other + 1;
      fields_[view] = find_field(scene_, views_[view], home_, known, mix(seed_, view), watch_);
    });
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

  Columns columns_of(std::size_t view) const {
    const PostureField* field = fields_[view].get();
    return {views_[view], support_.standing(), voxels_.keep, [field](const Vec3& cell) { return field->usable(cell); }};
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
    spared_[which] = false;
    const double stray = stray_of(scene_.tool(), scene_.grid().voxel_m).ball;
    std::size_t at_once = most_layers_at_once;
    for (int layer = voxels_.n() - 1; layer >= 0;) {
      std::vector<Layer> layers = plan_layers(which, columns, layer, at_once, stray);
      for_each_index(threads_, layers.size(), [&](std::size_t at) {
        layers[at].followed = follow(*field_, scene_.tool(), scene_.grid(), layers[at].from, layers[at].strokes);
      });
      const int next = commit(layers, columns);
      // Where one cut fails others do, and each time the rest was planned in vain.
      at_once = next == layers.back().next ? std::min(2 * at_once, most_layers_at_once) : 1;
      layer = next;
    }
    Vec3 end = at_;
    const std::vector<Stroke> rise = columns.rise(end, stray);
    const Followed up = follow(*field_, scene_.tool(), scene_.grid(), at_, rise);
    if (commit(up, rise) < rise.size()) throw std::logic_error("the tool came down where it cannot go up again");
    used_up_[which] = removed_ == before;
    // What was spared lest a piece come free may now be cut.
    if (removed_ > before)
      for (std::size_t view = 0; view < views_.size(); ++view) used_up_[view] = used_up_[view] && !spared_[view];
  }

  struct Layer {
    int c, next;  ///< the layer, and the one to go on with: itself, if a cut was given up
    Vec3 from;
    std::vector<Stroke> strokes;
    Followed followed;
  };

  /// What is to be done in the next layers from `c` down, as if nothing failed. Their number is the same at any number
  /// of threads.
  std::vector<Layer> plan_layers(std::size_t which, Columns& columns, int c, std::size_t at_once, double stray) {
    std::vector<Layer> layers;
    Vec3 end = at_;
    while (c >= 0 && layers.size() < at_once) {
      const Vec3 from = end;
      std::vector<Stroke> strokes = columns.cut_layer(c, end, stray);
      const bool whole = remove_held(from, strokes, columns);
      if (!whole) end = strokes.empty() ? from : strokes.back().to;
      spared_[which] |= !whole;
      layers.push_back({c, whole ? c - 1 : c, from, std::move(strokes), {}});
      c = layers.back().next;
    }
    return layers;
  }

  /// Ends the strokes before the first cut that would free a piece of material. That voxel is given up for this pass,
  /// what comes behind it is taken back.
  bool remove_held(const Vec3& from, std::vector<Stroke>& strokes, Columns& columns) {
    for (std::size_t s = 0; s < strokes.size(); ++s) {
      const Stroke stroke = strokes[s];
      if (stroke.count == 0) continue;
      const int held = support_.remove(VoxelLine{stroke.first, stroke.last});
      if (held == stroke.count) continue;
      const Vec3 start = s == 0 ? from : strokes[s - 1].to;
      for (std::size_t later = strokes.size(); later-- > s + 1;) columns.restore(strokes[later], false);
      if (held + 1 < stroke.count) columns.restore(part_of(stroke, start, held + 1, stroke.count - 1), false);
      columns.restore(part_of(stroke, start, held, held), true);
      strokes.resize(s);
      if (held > 0) strokes.push_back(part_of(stroke, start, 0, held - 1));
      while (!strokes.empty() && strokes.back().count == 0) strokes.pop_back();
      return false;
    }
    return true;
  }

  /// Emits what could be followed, takes back what comes after a failure, and returns the layer to go on with.
  int commit(const std::vector<Layer>& layers, Columns& columns) {
    for (std::size_t at = 0; at < layers.size(); ++at) {
      const auto& strokes = layers[at].strokes;
      const std::size_t done = commit(layers[at].followed, strokes);
      if (done == strokes.size()) continue;
      for (std::size_t later = layers.size(); later-- > at + 1;) take_back(layers[later].strokes, 0, columns, false);
      take_back(strokes, done, columns, true);
      return layers[at].c;
    }
    return layers.back().next;
  }

  /// Of a failed layer the first cut that could not be come to or not be made is given up.
  void take_back(const std::vector<Stroke>& strokes, std::size_t from, Columns& columns, bool failed) {
    std::size_t given_up = failed ? from : strokes.size();
    while (given_up < strokes.size() && strokes[given_up].count == 0) ++given_up;
    for (std::size_t s = strokes.size(); s-- > from;) {
      columns.restore(strokes[s], s == given_up);
      if (strokes[s].count > 0) support_.restore(VoxelLine{strokes[s].first, strokes[s].last});
    }
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
    for (const Configuration& q : way) {
      if (q == q_) continue;
      emit_({q, false, {}, {}});
      q_ = q;
    }
  }

  std::size_t commit(const Followed& followed, const std::vector<Stroke>& strokes) {
    for (const Keyframe& keyframe : followed.keyframes) {
      emit_(keyframe);
      q_ = keyframe.q;
      removed_ += static_cast<std::uint64_t>(run_length(keyframe));
    }
    if (followed.strokes > 0) at_ = strokes[followed.strokes - 1].to;
    return followed.strokes;
  }

  const Scene& scene_;
  const VoxelGrid& voxels_;
  Configuration home_;
  std::uint64_t seed_, transits_ = 0, removed_ = 0;
  int threads_;
  const std::function<void(const Keyframe&)>& emit_;
  const Watch& watch_;
  Support support_;  ///< of what stands when all that is planned is cut
  Configuration q_;
  Vec3 at_ = Vec3::Zero();               ///< the ball, in cells of the view of `field_`
  const PostureField* field_ = nullptr;  ///< of the direction in use; none at home
  std::vector<Configuration> way_home_;  ///< from the hub of that direction
  std::array<ToolView, 5> views_;
  std::array<std::unique_ptr<PostureField>, 5> fields_;
  std::array<bool, 5> used_up_{};
  std::array<bool, 5> spared_{};  ///< something was given up in the last pass lest a piece come free
};

}  // namespace

VoxelSet carve_by_sweeps(const Scene& scene, const VoxelGrid& voxels, const Configuration& home, std::uint64_t seed,
                         int threads, const std::function<void(const Keyframe&)>& emit, const Watch& watch) {
  return Sweep(scene, voxels, home, seed, threads, emit, watch).run();
}

}  // namespace sculpt
