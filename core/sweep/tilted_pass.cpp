#include "core/sweep/tilted_pass.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/base/helpers.hpp"
#include "core/sweep/slanted_cuts.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_sorties_at_once = 8;
/// Voxels a sortie: at first, and where all of them are followed.
constexpr std::size_t first_cuts = 256, max_cuts = 4096;

class TiltedPass {
 public:
  TiltedPass(Carving& carving, const PostureField& field, const std::vector<Voxel>& wanted)
      : support_(carving.support),
        arm_(carving.arm),
        helpers_(carving.run.helpers),
        field_(field),
        hub_(ToolView::place(field.hub())),
        cuts_(
            field.view(), carving.support.standing(), wanted, field.hub(),
            [&field](const Vec3& cell) { return field.usable(cell); }, [this](Voxel v) { return take(v); }) {}

  PassEnd run() {
    const std::uint64_t before = arm_.removed();
    std::size_t at_once = max_sorties_at_once, each = first_cuts;
    for (;;) {
      std::vector<Sortie> sorties = plan(at_once, each);
      if (sorties.empty()) break;
      if (arm_.field() != &field_ && !arm_.enter(field_)) {
        for (std::size_t planned = sorties.size(); planned-- > 0;) take_back(sorties[planned]);
        break;
      }
      std::vector<FollowedStrokes> followed(sorties.size());
      helpers_.for_each_index(
          sorties.size(), [&](std::size_t at) { followed[at] = arm_.try_strokes(field_, hub_, sorties[at].strokes); });
      const std::size_t done = commit(sorties, followed);
      for (std::size_t later = sorties.size(); later-- > done;) take_back(sorties[later]);
      if (done == sorties.size()) {
        at_once = std::min(2 * at_once, max_sorties_at_once);
        each = std::min(2 * each, max_cuts);
      } else {
        cuts_.give_up(sorties[done].strokes[sorties[done].serves[followed[done].strokes]]);
        at_once = 1;
        each = std::max<std::size_t>(each / 4, 1);
      }
    }
    return {arm_.removed() > before, spared_};
  }

 private:
  /// As if none failed. Their number is the same at any number of threads.
  std::vector<Sortie> plan(std::size_t at_once, std::size_t most) {
    std::vector<Sortie> sorties;
    while (sorties.size() < at_once) {
      Sortie sortie = cuts_.plan_sortie(most);
      if (sortie.cuts == 0) break;
      sorties.push_back(std::move(sortie));
    }
    return sorties;
  }

  /// From what stands, unless a piece would come free.
  bool take(Voxel voxel) {
    if (support_.frees(voxel)) {
      spared_ = true;
      return false;
    }
    support_.remove(voxel);
    return true;
  }

  void take_back(const Sortie& sortie) {
    for (std::size_t s = sortie.strokes.size(); s-- > 0;)
      if (sortie.strokes[s].cuts()) support_.restore(sortie.strokes[s].line());
    cuts_.take_back(sortie);
  }

  /// Emits the sorties before the first that could not be followed to its end, and says which that is.
  std::size_t commit(const std::vector<Sortie>& sorties, const std::vector<FollowedStrokes>& followed) {
    for (std::size_t at = 0; at < sorties.size(); ++at) {
      if (followed[at].strokes < sorties[at].strokes.size()) return at;
      arm_.commit(followed[at], sorties[at].strokes);
      if (arm_.at() != hub_) throw std::logic_error("a sortie does not end where the next one begins");
    }
    return sorties.size();
  }

  Support& support_;
  HubArm& arm_;
  const Helpers& helpers_;
  const PostureField& field_;
  Vec3 hub_;
  SlantedCuts cuts_;
  bool spared_ = false;  ///< something, lest a piece come free
};

}  // namespace

PassEnd cut_tilted(Carving& carving, const PostureField& field, const std::vector<Voxel>& wanted) {
  return TiltedPass(carving, field, wanted).run();
}

}  // namespace sculpt
