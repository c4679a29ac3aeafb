#include "core/sweep/straight_pass.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "core/base/helpers.hpp"

namespace sculpt {
namespace {

constexpr std::size_t first_layers_at_once = 8;  // so that there is soon something to write
constexpr std::size_t max_layers_at_once = 16;

struct Layer {
  int c;
  Vec3 from;
  std::vector<Stroke> strokes;
  FollowedStrokes followed;
};

struct Batch {
  std::vector<Layer> layers;
  Vec3 end;  ///< where the ball is then
};

StraightMark begin(const ToolView& view) {
  StraightMark mark;
  mark.layer = view.n - 1;
  mark.layers_at_once = first_layers_at_once;
  return mark;
}

class StraightPass {
 public:
  StraightPass(Carving& carving, const PostureField& field, const ReachRows& reach, StraightMark from)
      : support_(carving.support),
        arm_(carving.arm),
        helpers_(carving.run.helpers),
        field_(field),
        tolerance_(path_tolerance(carving.scene.tool(), carving.scene.grid().voxel_m).ball),
        columns_(field.view(), carving.support.standing(), carving.keep, reach, std::move(from.given_up)),
        now_(std::move(from)) {}

  /// `entered`: the arm is in the direction already. Else the way to its hub is found beside the first strokes.
  PassEnd run(bool entered, const NoteStraight& note) {
    const std::uint64_t before = arm_.removed();
    const bool cut_before = now_.so_far.cut;
    Batch batch = plan(entered ? arm_.at() : ToolView::place(field_.hub()));
    while (!batch.layers.empty()) {
      // As if nothing failed, what comes next is planned beside.
      now_.layers_at_once = std::min(2 * now_.layers_at_once, max_layers_at_once);
      StraightMark next = mark();
      Batch ahead;
      std::optional<HubArm::Entry> entry;
      helpers_.for_each_index(2 + batch.layers.size(), [&](std::size_t task) {
        if (task == 0) {
          if (!entered) entry = arm_.find_entry(field_);
        } else if (task == 1) {
          ahead = plan(batch.end);
        } else {
          Layer& layer = batch.layers[task - 2];
          layer.followed = arm_.try_strokes(field_, layer.from, layer.strokes);
        }
      });
      if (!entered && !entry) {
        take_back(ahead, 0);
        take_back(batch, 0);
        return now_.so_far;
      }
      if (entry) arm_.enter(std::move(*entry));
      entered = true;
      const auto failed = commit(batch, ahead);
      now_.so_far.cut = next.so_far.cut = cut_before || arm_.removed() > before;
      if (failed) {
        // Where one cut fails others do, and each time the rest was planned in vain.
        now_.layers_at_once = 1;
        now_.layer = *failed;
        end_layer();
        next = mark();
        ahead = plan(arm_.at());
      }
      note(next);
      batch = std::move(ahead);
    }
    if (entered) rise();
    return now_.so_far;
  }

 private:
  /// As of when nothing is planned that is not done.
  StraightMark mark() const {
    StraightMark mark = now_;
    mark.given_up = columns_.given_up();
    return mark;
  }

  /// What is to be done in the next layers, downwards, with the ball at `start`, as if nothing failed. Their number is
  /// the same at any number of threads.
  Batch plan(const Vec3& start) {
    Batch batch{{}, start};
    auto& [layers, end] = batch;
    while (now_.layer >= 0 && layers.size() < now_.layers_at_once) {
      const int c = now_.layer;
      const Vec3 from = end;
      std::vector<Stroke> strokes = columns_.cut_layer(c, end, tolerance_);
      const std::optional<Stroke> freeing = remove_held(from, strokes);
      if (freeing) end = strokes.empty() ? from : strokes.back().to;
      if (is_done(strokes, freeing)) --now_.layer;
      layers.push_back({c, from, std::move(strokes), {}});
    }
    return batch;
  }

  /// Ends the strokes before the first cut that would free a piece of material, and returns it. That voxel is given up,
  /// what comes behind it is taken back.
  std::optional<Stroke> remove_held(const Vec3& from, std::vector<Stroke>& strokes) {
    for (std::size_t s = 0; s < strokes.size(); ++s) {
      const Stroke stroke = strokes[s];
      if (!stroke.cuts()) continue;
      const int held = support_.remove(stroke.line());
      if (held == stroke.count) continue;
      const Vec3 start = s == 0 ? from : strokes[s - 1].to;
      for (std::size_t later = strokes.size(); later-- > s + 1;) columns_.restore(strokes[later], false);
      if (held + 1 < stroke.count) columns_.restore(part_of(stroke, start, held + 1, stroke.count - 1), false);
      const Stroke freeing = part_of(stroke, start, held, held);
      columns_.restore(freeing, true);
      strokes.resize(s);
      if (held > 0) strokes.push_back(part_of(stroke, start, 0, held - 1));
      while (!strokes.empty() && !strokes.back().cuts()) strokes.pop_back();
      return freeing;
    }
    return std::nullopt;
  }

  /// After one more try of a layer. What was given up in it is tried again when more was cut since: a piece that hangs
  /// on one side can be cut from its free end.
  bool is_done(const std::vector<Stroke>& strokes, const std::optional<Stroke>& freeing) {
    now_.cut_since |= !now_.held_here.empty() &&
                      std::any_of(strokes.begin(), strokes.end(), [](const Stroke& stroke) { return stroke.cuts(); });
    if (freeing) {
      now_.held_here.push_back(columns_.run_of(*freeing));
      return false;
    }
    if (!now_.cut_since) {
      end_layer();
      return true;
    }
    for (const Columns::Run& held : now_.held_here) columns_.try_again(held);
    now_.held_here.clear();
    now_.cut_since = false;
    return false;
  }

  void end_layer() {
    now_.so_far.spared |= !now_.held_here.empty();
    now_.held_here.clear();
    now_.cut_since = false;
  }

  /// Emits what could be followed. Where something failed it takes back what comes after, `ahead` as well, and says
  /// which layer to go on with.
  std::optional<int> commit(Batch& batch, const Batch& ahead) {
    auto& layers = batch.layers;
    for (std::size_t at = 0; at < layers.size(); ++at) {
      const auto& strokes = layers[at].strokes;
      const std::size_t done = arm_.commit(std::move(layers[at].followed), strokes);
      if (done == strokes.size()) continue;
      take_back(ahead, 0);
      take_back(batch, at + 1);
      take_back(strokes, done, true);
      return layers[at].c;
    }
    return std::nullopt;
  }

  void take_back(const Batch& batch, std::size_t from_layer) {
    for (std::size_t at = batch.layers.size(); at-- > from_layer;) take_back(batch.layers[at].strokes, 0, false);
  }

  /// Of a failed layer the first cut that could not be come to or not be made is given up.
  void take_back(const std::vector<Stroke>& strokes, std::size_t from, bool failed) {
    std::size_t given_up = failed ? from : strokes.size();
    while (given_up < strokes.size() && !strokes[given_up].cuts()) ++given_up;
    for (std::size_t s = strokes.size(); s-- > from;) {
      columns_.restore(strokes[s], s == given_up);
      if (strokes[s].cuts()) support_.restore(strokes[s].line());
    }
  }

  void rise() {
    Vec3 end = arm_.at();
    const std::vector<Stroke> up = columns_.rise(end, tolerance_);
    if (arm_.commit(arm_.try_strokes(field_, arm_.at(), up), up) < up.size())
      throw std::logic_error("the tool came down where it cannot go up again");
  }

  Support& support_;
  HubArm& arm_;
  const Helpers& helpers_;
  const PostureField& field_;
  double tolerance_;
  Columns columns_;
  StraightMark now_;  ///< as of what is planned; what was given up, `columns_` knows
};

}  // namespace

PassEnd cut_straight(Carving& carving, const PostureField& field, const ReachRows& reach,
                     const std::optional<StraightMark>& from, const NoteStraight& note) {
  return StraightPass(carving, field, reach, from.value_or(begin(field.view()))).run(from.has_value(), note);
}

}  // namespace sculpt
