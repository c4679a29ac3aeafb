#include "core/sweep/sweep.hpp"

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/parallel.hpp"
#include "core/base/random.hpp"
#include "core/cell/ik.hpp"
#include "core/material/support.hpp"
#include "core/motion/tool_axes.hpp"
#include "core/motion/tool_reach.hpp"
#include "core/motion/transit.hpp"
#include "core/sweep/find_field.hpp"
#include "core/sweep/follow.hpp"
#include "core/sweep/slanted_cuts.hpp"
#include "core/sweep/stock_turn.hpp"

namespace sculpt {
namespace {

constexpr std::size_t most_layers_at_once = 16;
constexpr std::size_t first_side = 1;  // of the views; four each of a kind follow
constexpr std::size_t most_sorties_at_once = 8, most_cuts = 256;
/// Voxels that make a field of a tilted direction, and the way there and back, worth their while.
constexpr std::uint64_t fewest_slanted = 4;

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
  Sweep(const Scene& scene, const VoxelGrid& voxels, const VoxelSet& may_fall, const Configuration& home,
        std::uint64_t seed, int threads, const std::function<void(std::vector<Keyframe>)>& emit, const Watch& watch)
      : scene_(scene),
        voxels_(voxels),
        home_(home),
        seed_(seed),
        threads_(threads),
        emit_(emit),
        watch_(watch),
        may_fall_(may_fall),
        turn_(find_stock_turn(scene.chain(), scene.grid())),
        q_(home) {
    for (const ToolView& view : tool_views(voxels.n())) views_.push_back(view);
    straight_ = views_.size();
    for (const ToolView& view : tilted_views(voxels.n())) views_.push_back(view);
    fields_.resize(views_.size());
    reach_.resize(straight_);
    used_up_.resize(views_.size());
    spared_.resize(views_.size());
  }

  SweepRest run() {
    begin();
    do {
      std::fill_n(used_up_.begin(), straight_, 0);
      while (const auto view = best_view()) carve_along(*view);
    } while (carve_slanted());
    go_home();
    return {support_->standing(), std::move(*out_of_reach_)};
  }

 private:
  void go_home() {
    if (transit(home_)) return;
    const auto way = way_home();
    if (!way)
      throw InputError("no_transit",
                       "the arm finds no way home from above the stock: keep what stands beside it lower");
    move(*way);
  }

  /// Finds what holds the material and the fields of the straight directions.
  void begin() {
    const std::size_t apart = turn_ ? first_side + 1 : straight_;
    for_each_index(threads_, apart + 1, [&](std::size_t task) {
      if (task < apart)
        find_field_of(task);
      else
        support_.emplace(voxels_.stock, may_fall_);
    });
    for (std::size_t view = apart; view < straight_; ++view) find_field_of(view);
    for_each_index(threads_, straight_, [&](std::size_t view) {
      const PostureField& field = *fields_[view];
      reach_[view].emplace(
          voxels_.n(), [&](const Vec3& cell) { return field.usable(cell); },
          [&](const Vec3& cell) { return field.part(cell); });
    });
  }

  /// The first of each four sides that are quarter turns of each other is searched for. It is turned into the others',
  /// if the stock can be.
  void find_field_of(std::size_t view) {
    if (fields_[view]) return;
    const std::size_t quarters = view < first_side ? 0 : (view - first_side) % 4;
    if (turn_ && quarters > 0) {
      find_field_of(view - quarters);
      fields_[view] = turn_field(*fields_[view - quarters], view, static_cast<double>(quarters));
    }
    if (!fields_[view]) fields_[view] = search_field(view);
  }

  std::unique_ptr<PostureField> search_field(std::size_t view) const {
    // Held as from home above the stock, with some joint turned, the arm may well come from another side.
    std::vector<Configuration> known;
    const IkGoal hub{views_[0].ball_m(scene_.grid(), hub_cell()), views_[0].axis()};
    if (const auto above = solve_ik(scene_.chain(), hub, home_); above && view > 0) known.push_back(*above);
    return find_field(scene_, views_[view], home_, known, mix(seed_, view), threads_, watch_);
  }

  /// Nothing if the joint does not turn so far.
  std::unique_ptr<PostureField> turn_field(const PostureField& field, std::size_t view, double quarters) const {
    for (double rounds : {0, -1, 1}) {
      const double by = turn_->direction * (quarters / 4 + rounds) * 2 * std::numbers::pi;
      if (field.can_turn(turn_->coordinate, by))
        return std::make_unique<PostureField>(field, views_[view],
                                              by * Configuration::Unit(scene_.chain().dof(), turn_->coordinate));
    }
    return nullptr;
  }

  /// The direction along which most can be cut now, of those that are not used up.
  std::optional<std::size_t> best_view() const {
    std::vector<std::uint64_t> counts(straight_);
    for_each_index(threads_, straight_, [&](std::size_t view) {
      if (!used_up_[view]) counts[view] = columns_of(view).count_cuttable();
    });
    const auto most = std::max_element(counts.begin(), counts.end());
    if (*most == 0) return std::nullopt;
    return static_cast<std::size_t>(most - counts.begin());
  }

  Columns columns_of(std::size_t view) const {
    return {views_[view], support_->standing(), voxels_.keep, *reach_[view]};
  }

  /// A direction without a field may reach everything.
  std::function<bool(const Vec3&)> reachable(std::size_t view) const {
    const PostureField* field = fields_[view].get();
    return [field](const Vec3& cell) { return field == nullptr || field->usable(cell); };
  }

  /// Where the tool comes in: above the middle of the grid.
  Voxel gate() const { return {voxels_.n() / 2, voxels_.n() / 2, voxels_.n() + 1}; }
  Vec3 hub_cell() const { return Vec3(gate().i, gate().j, gate().k); }

  /// Cuts all that lies free along one direction, layer by layer.
  void carve_along(std::size_t which) {
    const std::uint64_t before = removed_;
    if (!enter(which)) {
      used_up_[which] = true;
      return;
    }
    Columns columns = columns_of(which);
    spared_[which] = cut_since_ = false;
    held_here_.clear();
    const double stray = stray_of(scene_.tool(), scene_.grid().voxel_m).ball;
    std::size_t at_once = most_layers_at_once;
    Batch batch = plan_layers(which, columns, voxels_.n() - 1, at_, at_once, stray);
    while (!batch.layers.empty()) {
      // As if nothing failed, what comes next is planned beside.
      at_once = std::min(2 * at_once, most_layers_at_once);
      Batch ahead;
      for_each_index(threads_, 1 + batch.layers.size(), [&](std::size_t task) {
        if (task == 0) {
          ahead = plan_layers(which, columns, batch.layers.back().next, batch.end, at_once, stray);
          return;
        }
        Layer& layer = batch.layers[task - 1];
        layer.followed = follow(*field_, scene_.tool(), scene_.grid(), layer.from, layer.strokes);
      });
      if (const auto failed = commit(batch, ahead, columns)) {
        // Where one cut fails others do, and each time the rest was planned in vain.
        at_once = 1;
        spared_[which] |= !held_here_.empty();
        held_here_.clear();
        cut_since_ = false;
        ahead = plan_layers(which, columns, *failed, at_, at_once, stray);
      }
      batch = std::move(ahead);
    }
    Vec3 end = at_;
    const std::vector<Stroke> rise = columns.rise(end, stray);
    Followed up = follow(*field_, scene_.tool(), scene_.grid(), at_, rise);
    if (commit(std::move(up), rise) < rise.size())
      throw std::logic_error("the tool came down where it cannot go up again");
    end_pass(which, removed_ > before);
  }

  void end_pass(std::size_t which, bool cut) {
    used_up_[which] = !cut;
    if (!cut) return;
    // What was spared lest a piece come free may now be cut.
    for (std::size_t view = 0; view < views_.size(); ++view) used_up_[view] = used_up_[view] && !spared_[view];
  }

  struct Layer {
    int c, next;  ///< the layer, and the one to go on with: itself, if a cut was given up
    Vec3 from;
    std::vector<Stroke> strokes;
    Followed followed;
  };

  struct Batch {
    std::vector<Layer> layers;
    Vec3 end;  ///< where the ball is then
  };

  /// What is to be done in the next layers from `c` down with the ball at `start`, as if nothing failed. Their number
  /// is the same at any number of threads.
  Batch plan_layers(std::size_t which, Columns& columns, int c, const Vec3& start, std::size_t at_once, double stray) {
    Batch batch{{}, start};
    auto& [layers, end] = batch;
    while (c >= 0 && layers.size() < at_once) {
      const Vec3 from = end;
      std::vector<Stroke> strokes = columns.cut_layer(c, end, stray);
      const std::optional<Stroke> freeing = remove_held(from, strokes, columns);
      if (freeing) end = strokes.empty() ? from : strokes.back().to;
      const bool done = is_done(which, strokes, freeing, columns);
      layers.push_back({c, done ? c - 1 : c, from, std::move(strokes), {}});
      c = layers.back().next;
    }
    return batch;
  }

  /// After one more try of a layer. What was given up in it is tried again when more was cut since: a piece that hangs
  /// on one side can be cut from its free end.
  bool is_done(std::size_t which, const std::vector<Stroke>& strokes, const std::optional<Stroke>& freeing,
               Columns& columns) {
    const auto cuts = [](const Stroke& stroke) { return stroke.count > 0; };
    cut_since_ |= !held_here_.empty() && std::any_of(strokes.begin(), strokes.end(), cuts);
    if (freeing) {
      held_here_.push_back(*freeing);
      return false;
    }
    const bool done = !cut_since_;
    if (done)
      spared_[which] |= !held_here_.empty();
    else
      for (const Stroke& held : held_here_) columns.try_again(held);
    held_here_.clear();
    cut_since_ = false;
    return done;
  }

  /// Ends the strokes before the first cut that would free a piece of material, and returns it. That voxel is given up,
  /// what comes behind it is taken back.
  std::optional<Stroke> remove_held(const Vec3& from, std::vector<Stroke>& strokes, Columns& columns) {
    for (std::size_t s = 0; s < strokes.size(); ++s) {
      const Stroke stroke = strokes[s];
      if (stroke.count == 0) continue;
      const int held = support_->remove(VoxelLine{stroke.first, stroke.last});
      if (held == stroke.count) continue;
      const Vec3 start = s == 0 ? from : strokes[s - 1].to;
      for (std::size_t later = strokes.size(); later-- > s + 1;) columns.restore(strokes[later], false);
      if (held + 1 < stroke.count) columns.restore(part_of(stroke, start, held + 1, stroke.count - 1), false);
      const Stroke freeing = part_of(stroke, start, held, held);
      columns.restore(freeing, true);
      strokes.resize(s);
      if (held > 0) strokes.push_back(part_of(stroke, start, 0, held - 1));
      while (!strokes.empty() && strokes.back().count == 0) strokes.pop_back();
      return freeing;
    }
    return std::nullopt;
  }

  /// Emits what could be followed. Where something failed it takes back what comes after, `ahead` as well, and says
  /// which layer to go on with.
  std::optional<int> commit(Batch& batch, const Batch& ahead, Columns& columns) {
    auto& layers = batch.layers;
    for (std::size_t at = 0; at < layers.size(); ++at) {
      const auto& strokes = layers[at].strokes;
      const std::size_t done = commit(std::move(layers[at].followed), strokes);
      if (done == strokes.size()) continue;
      for (auto later = ahead.layers.rbegin(); later != ahead.layers.rend(); ++later)
        take_back(later->strokes, 0, columns, false);
      for (std::size_t later = layers.size(); later-- > at + 1;) take_back(layers[later].strokes, 0, columns, false);
      take_back(strokes, done, columns, true);
      return layers[at].c;
    }
    return std::nullopt;
  }

  /// Of a failed layer the first cut that could not be come to or not be made is given up.
  void take_back(const std::vector<Stroke>& strokes, std::size_t from, Columns& columns, bool failed) {
    std::size_t given_up = failed ? from : strokes.size();
    while (given_up < strokes.size() && strokes[given_up].count == 0) ++given_up;
    for (std::size_t s = strokes.size(); s-- > from;) {
      columns.restore(strokes[s], s == given_up);
      restore(strokes[s]);
    }
  }

  /// Along tilted directions what no straight one came to. False if nothing was cut.
  bool carve_slanted() {
    if (!out_of_reach_) {
      VoxelSet rest = support_->standing();
      rest -= voxels_.keep;
      for_each_voxel(rest, [&](Voxel v) { wanted_.push_back(v); });
      const double length = scene_.tool().stickout_m / scene_.grid().voxel_m;
      out_of_reach_ = find_out_of_tool_reach(support_->standing(), wanted_, tool_steps(), length, watch_);
      for (const Voxel v : *out_of_reach_) rest.erase(v);
      std::erase_if(wanted_, [&](Voxel v) { return !rest.contains(v); });
    }
    const std::uint64_t before = removed_;
    while (const auto view = best_tilted_view()) carve_slanted(*view);
    return removed_ > before;
  }

  std::optional<std::size_t> best_tilted_view() {
    std::erase_if(wanted_, [&](Voxel v) { return !support_->standing().contains(v); });
    if (wanted_.size() < fewest_slanted) return std::nullopt;
    std::vector<std::uint64_t> counts(views_.size());
    for_each_index(threads_, views_.size() - straight_, [&](std::size_t tilted) {
      if (!used_up_[straight_ + tilted]) counts[straight_ + tilted] = count_slanted(straight_ + tilted);
    });
    const auto most = std::max_element(counts.begin(), counts.end());
    if (*most < fewest_slanted) return std::nullopt;
    return static_cast<std::size_t>(most - counts.begin());
  }

  std::uint64_t count_slanted(std::size_t which) const {
    const ToolView& view = views_[which];
    const auto may_reach = reachable(which);
    std::vector<Voxel> wanted = wanted_;
    std::erase_if(wanted, [&](Voxel v) {
      const Voxel cell = view.cell(v);
      return !may_reach(Vec3(cell.i, cell.j, cell.k));
    });
    const double all_through = 2.0 * voxels_.n();
    return wanted.size() -
           find_out_of_tool_reach(support_->standing(), wanted, {view.along(view.lean)}, all_through, watch_).size();
  }

  void carve_slanted(std::size_t which) {
    find_field_of(which);
    const std::uint64_t before = removed_;
    spared_[which] = false;
    SlantedCuts cuts(views_[which], support_->standing(), wanted_, gate(), reachable(which));
    std::size_t at_once = most_sorties_at_once, each = most_cuts;
    for (;;) {
      std::vector<Sortie> sorties = plan_sorties(cuts, at_once, each);
      if (sorties.empty()) break;
      const std::optional<Stroke> freeing = remove_held(sorties, cuts);
      spared_[which] |= freeing.has_value();
      if (freeing) cuts.give_up(*freeing);
      if (sorties.empty()) continue;
      if (field_ != fields_[which].get() && !enter(which)) {
        for (std::size_t planned = sorties.size(); planned-- > 0;) take_back(sorties[planned], cuts);
        break;
      }
      std::vector<Followed> followed(sorties.size());
      for_each_index(threads_, sorties.size(), [&](std::size_t at) {
        followed[at] = follow(*field_, scene_.tool(), scene_.grid(), hub_cell(), sorties[at].strokes);
      });
      const std::size_t done = commit(sorties, followed);
      for (std::size_t later = sorties.size(); later-- > done;) take_back(sorties[later], cuts);
      if (done == sorties.size()) {
        at_once = std::min(2 * at_once, most_sorties_at_once);
        each = std::min(2 * each, most_cuts);
      } else {
        cuts.give_up(sorties[done].strokes[sorties[done].serves[followed[done].strokes]]);
        at_once = 1;
        each = std::max<std::size_t>(each / 4, 1);
      }
    }
    end_pass(which, removed_ > before);
  }

  /// As if none failed. Their number is the same at any number of threads.
  static std::vector<Sortie> plan_sorties(SlantedCuts& cuts, std::size_t at_once, std::size_t most) {
    std::vector<Sortie> sorties;
    while (sorties.size() < at_once) {
      Sortie sortie = cuts.plan_sortie(most);
      if (sortie.cuts == 0) break;
      sorties.push_back(std::move(sortie));
    }
    return sorties;
  }

  /// Drops the first sortie that would free a piece of material and all behind it; says which cut would.
  std::optional<Stroke> remove_held(std::vector<Sortie>& sorties, SlantedCuts& cuts) {
    for (std::size_t at = 0; at < sorties.size(); ++at) {
      auto& strokes = sorties[at].strokes;
      for (std::size_t s = 0; s < strokes.size(); ++s) {
        const Stroke stroke = strokes[s];
        if (stroke.count == 0) continue;
        const int held = support_->remove(VoxelLine{stroke.first, stroke.last});
        if (held == stroke.count) continue;
        if (held > 0) restore(part_of(stroke, Vec3::Zero(), 0, held - 1));
        for (std::size_t before = s; before-- > 0;) restore(strokes[before]);
        for (std::size_t later = sorties.size(); later-- > at;) cuts.take_back(sorties[later]);
        sorties.resize(at);
        return stroke;
      }
    }
    return std::nullopt;
  }

  void take_back(const Sortie& sortie, SlantedCuts& cuts) {
    for (std::size_t s = sortie.strokes.size(); s-- > 0;) restore(sortie.strokes[s]);
    cuts.take_back(sortie);
  }

  void restore(const Stroke& stroke) {
    if (stroke.count > 0) support_->restore(VoxelLine{stroke.first, stroke.last});
  }

  /// Emits the sorties before the first that could not be followed to its end, and says which that is.
  std::size_t commit(const std::vector<Sortie>& sorties, const std::vector<Followed>& followed) {
    for (std::size_t at = 0; at < sorties.size(); ++at) {
      if (followed[at].strokes < sorties[at].strokes.size()) return at;
      commit(followed[at], sorties[at].strokes);
      if (at_ != hub_cell()) throw std::logic_error("a sortie does not end where the next one begins");
    }
    return sorties.size();
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
    for (const Keyframe& keyframe : followed.keyframes)
      if (keyframe.cut) removed_ += static_cast<std::uint64_t>(run_length(keyframe));
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
  const VoxelSet& may_fall_;
  std::optional<Support> support_;  ///< of what stands when all that is planned is cut
  std::optional<StockTurn> turn_;
  std::vector<Voxel> wanted_;                       ///< of what straight directions left, what tilted ones might cut
  std::optional<std::vector<Voxel>> out_of_reach_;  ///< what no direction can, once that was asked
  Configuration q_;
  Vec3 at_ = Vec3::Zero();               ///< the ball, in cells of the view of `field_`
  const PostureField* field_ = nullptr;  ///< of the direction in use; none at home
  std::vector<Configuration> way_home_;  ///< from the hub of that direction
  std::vector<ToolView> views_;          ///< the straight ones, then the tilted ones
  std::size_t straight_ = 0;             ///< how many
  std::vector<std::unique_ptr<PostureField>> fields_;
  std::vector<std::optional<ReachRows>> reach_;  ///< where the field of a straight one is usable
  std::vector<char> used_up_;                    ///< the last pass along it cut nothing
  std::vector<Stroke> held_here_;                ///< given up in the layer at hand: each held a piece of material
  bool cut_since_ = false;                       ///< something was cut in that layer since
  std::vector<char> spared_;                     ///< something was given up in the last pass lest a piece come free
};

}  // namespace

SweepRest carve_by_sweeps(const Scene& scene, const VoxelGrid& voxels, const VoxelSet& may_fall,
                          const Configuration& home, std::uint64_t seed, int threads,
                          const std::function<void(std::vector<Keyframe>)>& emit, const Watch& watch) {
  return Sweep(scene, voxels, may_fall, home, seed, threads, emit, watch).run();
}

}  // namespace sculpt
