#include "core/mill/finish/contour_runner.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <tuple>

#include "core/mill/drive/hop.hpp"

namespace sculpt {
namespace {

/// From contour to contour along the surface, where that is no farther (row spacings); and where there is no other way.
constexpr double beside_spacings = 60, far_beside_spacings = 240;
constexpr std::size_t strokes_a_batch = 100, looked_at = 6, ends_looked_at = 200;
constexpr int max_refused = 60;

/// Goes on around from the contour of this number, backwards from its end.
void turn_to(std::vector<Contour>& contours, std::size_t number, bool is_back) {
  std::rotate(contours.begin(), contours.begin() + static_cast<std::ptrdiff_t>(number), contours.end());
  if (!is_back) return;
  std::reverse(contours.begin() + 1, contours.end());
  for (Contour& contour : contours) std::ranges::reverse(contour);
}

}  // namespace

void ContourRunner::run(std::vector<Contour> tour) {
  const double low = -std::numeric_limits<double>::infinity(), high = carver_.hub().z(),
               beside_m = beside_spacings * spacing_m_;
  std::vector<Contour> left = carry_out({low, beside_m, false}, std::move(tour));
  left = carry_out({high, beside_m, false}, std::move(left));
  if (!left.empty()) {
    find_air_ways();
    carry_out({low, far_beside_spacings * spacing_m_, true}, std::move(left));
  }
  carver_.draw_back(site_);
}

void ContourRunner::find_air_ways() {
  air_ =
      std::make_unique<const AirWays>(site_, carver_.reach(), carver_.hub(), carver_.bottom(site_.frame()), refused_);
}

/// Gives those that it found no way to.
std::vector<Contour> ContourRunner::carry_out(const Ways& ways, std::vector<Contour> contours) {
  std::vector<Contour> apart;
  for (int refused = 0; !contours.empty() && refused < max_refused;) {
    carver_.draw_back(site_);
    ContourStrokes laid({site_, envelope_, carver_.tool(), carver_.swept(), job_.grid.voxel_m, job_.wishes.stray_m(),
                         ways.beside_m, ways.min_height},
                        carver_.left(), carver_.tip(site_));
    auto [batch, ahead, done] = follow_batches(ways, contours, laid, apart);
    std::ranges::move(ahead.apart, std::back_inserter(apart));
    // What was to come after the one that failed, or after a place that nothing leads on from, is planned anew.
    std::vector<Contour> rest;
    if (done < batch.strokes.size()) {
      ++refused;
      const auto failed = std::ranges::upper_bound(batch.contours, done, {}, &Laid::begin) - 1;
      if (ways.by_air && failed->is_by_air && !batch.strokes[done].cut) {
        // By another way, perhaps.
        refused_.push_back(site_.frame().of(batch.strokes[done].tip_m));
        find_air_ways();
        rest.push_back(std::move(failed->contour));
      } else if (!batch.strokes[done].cut) {
        apart.push_back(std::move(failed->contour));
      }
      for (auto next = failed + 1; next != batch.contours.end(); ++next) rest.push_back(std::move(next->contour));
      for (Laid& next : ahead.contours) rest.push_back(std::move(next.contour));
    }
    std::ranges::move(contours, std::back_inserter(rest));
    contours = std::move(rest);
  }
  carver_.settle();
  return apart;
}

/// Until all is laid, or nothing leads on, or the arm does not come to the end of a batch.
ContourRunner::BatchesDone ContourRunner::follow_batches(const Ways& ways, std::vector<Contour>& contours,
                                                         ContourStrokes& laid, std::vector<Contour>& apart) {
  BatchesDone last{{}, lay_batch(ways, contours, laid), 0};
  while (!last.ahead.contours.empty() && last.done == last.batch.strokes.size()) {
    last.batch = std::exchange(last.ahead, {});
    std::ranges::move(last.batch.apart, std::back_inserter(apart));
    // While the arm follows, the next one is laid; it counts on this one.
    run_.helpers.for_each_index(2, [&](std::size_t which) {
      if (which == 0)
        last.done = carver_.carry_out(last.batch.strokes);
      else
        last.ahead = lay_batch(ways, contours, laid);
    });
  }
  return last;
}

ContourRunner::Batch ContourRunner::lay_batch(const Ways& ways, std::vector<Contour>& contours,
                                              ContourStrokes& laid) const {
  Batch batch;
  while (!contours.empty() && laid.strokes().size() < strokes_a_batch && lay_next(ways, contours, laid, batch))
    continue;
  batch.strokes = laid.take_strokes();
  return batch;
}

/// False where nothing leads on from the last one, or to none of them.
bool ContourRunner::lay_next(const Ways& ways, std::vector<Contour>& contours, ContourStrokes& laid,
                             Batch& batch) const {
  Course course;
  if (!turn_to_next(ways, contours, laid, course)) {
    if (!laid.has_laid()) batch.apart = std::exchange(contours, {});
    return false;
  }
  Contour contour = std::move(contours.front());
  contours.erase(contours.begin());
  const std::size_t begin = laid.strokes().size();
  laid.lay(contour, course.way, course.air);
  batch.contours.push_back({std::move(contour), begin, !course.air.empty()});
  return true;
}

/// To the next of the tour; where that is too far for the robot, to where it may be gone on with. The contours begin
/// there then; false where there is no such place.
bool ContourRunner::turn_to_next(const Ways& ways, std::vector<Contour>& contours, const ContourStrokes& laid,
                                 Course& course) const {
  const std::optional<Entry> entry =
      laid.has_laid() ? find_next(ways, contours, laid, course) : find_begin(ways, contours, laid.at(), course);
  if (!entry) return false;
  turn_to(contours, entry->number, entry->is_back);
  return true;
}

/// Along the surface or from above.
std::optional<ContourRunner::Entry> ContourRunner::find_next(const Ways& ways, const std::vector<Contour>& contours,
                                                             const ContourStrokes& laid, Course& course) const {
  const auto goes_beside = [&](const Entry& entry) {
    if (laid.is_down()) course.way = laid.way_to(place_of(contours, entry));
    return !course.way.empty();
  };
  const auto goes_over = [&](const Entry& entry) { return comes_over(ways, laid.at(), place_of(contours, entry)); };
  const Entry next{0, 0, false};
  if (goes_beside(next) || goes_over(next)) return next;
  const std::vector<Entry> entries = nearest_entries(laid.at(), contours, looked_at);
  auto found = std::ranges::find_if(entries, goes_beside);
  if (found == entries.end()) found = std::ranges::find_if(entries, goes_over);
  return found != entries.end() ? std::optional(*found) : std::nullopt;
}

/// From above or through the air; if it can be so that the tour ends where the robot draws back from, for else it goes
/// back all of the way that it has cut.
std::optional<ContourRunner::Entry> ContourRunner::find_begin(const Ways& ways, const std::vector<Contour>& contours,
                                                              const Vec3& at, Course& course) const {
  const auto goes_over = [&](const Entry& entry) { return comes_over(ways, at, place_of(contours, entry)); };
  const auto goes_there_and_back = [&](const Entry& entry) {
    return comes_over(ways, end_of_tour(contours, entry), at) && goes_over(entry);
  };
  const Entry first{0, 0, false};
  if (goes_there_and_back(first)) return first;
  const std::vector<Entry> entries = nearest_entries(at, contours, 2 * contours.size());
  const auto near = entries.begin() + static_cast<std::ptrdiff_t>(std::min(ends_looked_at, entries.size()));
  auto found = std::find_if(entries.begin(), near, goes_there_and_back);
  if (found == near) found = std::ranges::find_if(entries, goes_over);
  if (found == entries.end() && ways.by_air)
    found = std::ranges::find_if(entries, [&](const Entry& entry) {
      course.air = air_->to(place_of(contours, entry));
      return !course.air.empty();
    });
  return found != entries.end() ? std::optional(*found) : std::nullopt;
}

const Vec3& ContourRunner::place_of(const std::vector<Contour>& contours, const Entry& entry) {
  return entry.is_back ? contours[entry.number].back() : contours[entry.number].front();
}

/// Where a tour that is begun there ends: around, at the contour beside.
const Vec3& ContourRunner::end_of_tour(const std::vector<Contour>& contours, const Entry& begin) {
  const std::size_t beside = begin.is_back ? begin.number + 1 : begin.number + contours.size() - 1;
  const Contour& last = contours[beside % contours.size()];
  return begin.is_back ? last.front() : last.back();
}

std::vector<ContourRunner::Entry> ContourRunner::nearest_entries(const Vec3& at, const std::vector<Contour>& contours,
                                                                 std::size_t most) {
  std::vector<Entry> entries;
  for (std::size_t number = 0; number < contours.size(); ++number) {
    entries.push_back({(contours[number].front() - at).squaredNorm(), number, false});
    entries.push_back({(contours[number].back() - at).squaredNorm(), number, true});
  }
  const std::size_t some = std::min(most, entries.size());
  std::ranges::partial_sort(entries, entries.begin() + static_cast<std::ptrdiff_t>(some),
                            [](const Entry& a, const Entry& b) {
                              return std::tie(a.far2, a.number, a.is_back) < std::tie(b.far2, b.number, b.is_back);
                            });
  entries.resize(some);
  return entries;
}

/// Does the robot hold the tip as high as it goes over?
bool ContourRunner::comes_over(const Ways& ways, const Vec3& from, const Vec3& to) const {
  const double height = std::max(site_.clear_height(from, to, air_clearance_m, air_beside_m), ways.min_height);
  const auto is_held = [&](const Vec3& at) { return carver_.reach().allows({at.x(), at.y(), height}); };
  return is_held(from) && is_held(to);
}

}  // namespace sculpt
