#include "core/program/make_program.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "core/program/digits.hpp"
#include "core/program/part_stock.hpp"
#include "core/program/read/main_reader.hpp"
#include "core/program/read/part_reader.hpp"
#include "core/program/seams.hpp"
#include "core/program/write/ros2.hpp"
#include "core/timing/demand/motion_limits.hpp"
#include "core/timing/edge.hpp"
#include "core/timing/stop_times.hpp"

namespace sculpt {
namespace {

class ProgramMaker {
 public:
  ProgramMaker(const PlanPath& path, const Cell& cell, const Chain& chain, const ProgramDemands& demands,
               const std::function<void(const ProgramFile&)>& take)
      : path_(path),
        cell_(cell),
        demands_(demands),
        take_(take),
        limits_(limits_of(cell, chain)),
        layout_(lay_out_axes(cell, chain, demands.dialect)),
        tools_(path, cell, demands.motion.reserve_m),
        digits_(demands.dialect, layout_, path) {
    for (const AxisLayout::Axis& axis : layout_.axes) letters_.push_back(axis.name);
    if (demands.stock_files) stock_.emplace(path);
  }

  ProgramReport run() {
    const Feeds feeds{demands_.motion.feed_m_s, demands_.motion.rapid_m_s};
    seams_ = find_seams(path_, cell_, tools_, part_size(feeds));
    names_ = {demands_.name, 0, seams_.size() + 1, {}};
    begin_part({});
    for_each_stop(path_, tools_, limits_, feeds, [&](std::size_t point, const StopTime& time) {
      if (names_.part <= seams_.size() && seams_[names_.part - 1].point == point - 1) {
        const Seam& seam = seams_[names_.part - 1];
        retreat(seam);
        end_part();
        begin_part(seam);
        come_back(seam);
      }
      add({path_.configuration(point), point, tools_.on_edge_to(path_, point)}, time);
    });
    end_part();
    if (facts_of(demands_.dialect).has_main) write_main_program();
    report_.parts = names_.parts;
    return report_;
  }

 private:
  PartSize part_size(const Feeds& feeds) {
    PartSize size{demands_.part_keyframes.value_or(facts_of(demands_.dialect).part_keyframes), demands_.seams_in_stock};
    if (!demands_.part_bytes) return size;
    TextMeter meter(demands_.dialect, layout_, {demands_.name, 0, 0, longest_mount()}, path_.configuration(0));
    for_each_stop(path_, tools_, limits_, feeds, [&](std::size_t point, const StopTime& time) {
      meter.add({digits_.axes_at({path_.configuration(point), point, tools_.on_edge_to(path_, point)}), time.seconds,
                 time.share});
    });
    size.text = meter.take(*demands_.part_bytes);
    return size;
  }

  std::optional<ToolMount> longest_mount() const {
    std::optional<ToolMount> longest;
    if (!path_.header().mill) return longest;
    for (const MillTool& tool : path_.header().mill->tools)
      if (!longest || tool.name.size() > longest->name.size()) longest = {std::numeric_limits<int>::max(), tool.name};
    return longest;
  }

  bool is_changed_at(std::size_t point) const {
    return point > 0 && path_.edge_to(point + 1).tool != path_.edge_to(point).tool;
  }

  /// Of the part that begins there.
  std::optional<ToolMount> mount_at(std::size_t point) const {
    if (!path_.header().mill || (point > 0 && !is_changed_at(point))) return {};
    const MillTool& tool = path_.header().mill->tools[path_.edge_to(point + 1).tool];
    return ToolMount{tool.number, tool.name};
  }

  void begin_part(const Seam& seam) {
    ++names_.part;
    names_.mount = mount_at(seam.point);
    names_.voxels.before = names_.voxels.after;
    const std::size_t end = names_.part <= seams_.size() ? seams_[names_.part - 1].point : path_.size() - 1;
    for (std::size_t point = names_.part == 1 ? 0 : seam.point + 1; point <= end; ++point)
      names_.voxels.after += path_.edge_to(point).removed;
    if (stock_) hand_out({names_.part_name() + ".binvox", stock_->at(seam.point)});
    const Configuration q = seam.retreat.empty() ? path_.configuration(seam.point) : seam.retreat.back();
    places_.clear();
    times_.clear();
    places_.push_back({q, seam.point, tools_.on_edge_to(path_, seam.point + 1)});
    writer_ = write_part(demands_.dialect, layout_, names_, digits_.axes_at(places_.back()));
  }

  void add(ProgramPlace place, const StopTime& time) {
    writer_->add({digits_.axes_at(place), time.seconds, time.share});
    times_.push_back(time);
    places_.push_back(std::move(place));
  }

  void retreat(const Seam& seam) {
    for (const Configuration& q : seam.retreat) add_rapid({q, seam.point, tools_.on_edge_to(path_, seam.point)});
  }

  void come_back(const Seam& seam) {
    const PathTool& tool = tools_.on_edge_to(path_, seam.point + 1);
    for (std::size_t at = seam.retreat.size(); at-- > 0;)
      add_rapid(at > 0 ? ProgramPlace{seam.retreat[at - 1], seam.point, tool}
                       : ProgramPlace{path_.configuration(seam.point), seam.point, tool});
  }

  void add_rapid(ProgramPlace place) {
    EdgePlaces places;
    const Configuration from = places_.back().q;
    places.begin.put(place.tool.rates, from);
    const StopTime time = stop_time(place.tool, limits_, demands_.motion.rapid_m_s, from, place.q, places);
    ++report_.retreat_moves;
    add(std::move(place), time);
  }

  void end_part() {
    const std::vector<ProgramFile> files = writer_->finish();
    check(read_part(demands_.dialect, files.front().text, letters_));
    std::uint64_t bytes = 0;
    for (const ProgramFile& file : files) bytes += file.text.size();
    if (demands_.part_bytes && bytes > *demands_.part_bytes)
      throw InputError("program_damaged",
                       "a part came out larger than --part-bytes: this is a fault of this program, "
                       "please report it");
    for (const ProgramFile& file : files) hand_out(file);
  }

  void write_main_program() {
    const std::vector<ProgramFile> files = write_main(demands_.dialect, demands_.name, names_.parts);
    std::vector<std::string> parts;
    for (std::size_t part = 1; part <= names_.parts; ++part)
      parts.push_back(ProgramNames{demands_.name, part, 0, {}}.part_name());
    if (read_main(demands_.dialect, files.front().text, files.back().text) != parts)
      throw InputError("program_damaged",
                       "the main program calls other parts than there are: this is a fault of this "
                       "program, please report it");
    for (const ProgramFile& file : files) hand_out(file);
  }

  void hand_out(const ProgramFile& file) {
    ++report_.files;
    report_.bytes += file.text.size();
    take_(file);
  }

  Configuration joints_of(const std::vector<double>& values, bool radians) const {
    Configuration axes(static_cast<Eigen::Index>(values.size()));
    for (std::size_t at = 0; at < values.size(); ++at)
      axes[static_cast<Eigen::Index>(at)] = radians                  ? values[at]
                                            : layout_.axes[at].turns ? values[at] * std::numbers::pi / 180
                                                                     : values[at] / 1000;
    return layout_.to_joints(axes);
  }

  void check(const ReadPart& part) {
    if (part.moves.size() != times_.size() || part.start.size() != layout_.axes.size())
      throw InputError("program_damaged",
                       "a part that was written holds other moves than the plan: this is a fault of "
                       "this program, please report it");
    if (part.tool != (names_.mount ? names_.mount->number : 0))
      throw InputError("program_damaged",
                       "a part that was written mounts another tool than the plan has: this is a fault of this "
                       "program, please report it");
    if (part.cut_before != names_.voxels.before || part.cut_after != names_.voxels.after)
      throw InputError("program_damaged",
                       "a part that was written tells of other voxels than the plan has: this is a fault of this "
                       "program, please report it");
    DigitStray before = digits_.check_place(places_.front(), joints_of(part.start, part.radians));
    for (std::size_t at = 0; at < part.moves.size(); ++at) {
      const ReadMove& move = part.moves[at];
      const DigitStray stray = digits_.check_place(places_[at + 1], joints_of(move.values, part.radians));
      digits_.check_move({places_[at], before}, {places_[at + 1], stray});
      report_.rounding_m = std::max({report_.rounding_m, before.tool_m, stray.tool_m});
      before = stray;
      const StopTime& time = times_[at];
      const bool slow_enough = move.seconds > 0 ? move.seconds >= time.seconds * (1 - 1e-6) - 1e-9
                                                : move.share > 0 && move.share <= time.share * (1 + 1e-9);
      if (!slow_enough)
        throw InputError("program_damaged", "the move to keyframe " +
                                                std::to_string(path_.edge_to(places_[at + 1].point).keyframe) +
                                                " was written faster than it may be: this is a fault of this program, "
                                                "please report it");
      report_.seconds += move.seconds > 0 ? move.seconds : time.seconds * time.share / move.share;
      ++report_.moves;
    }
  }

  const PlanPath& path_;
  const Cell& cell_;
  const ProgramDemands& demands_;
  const std::function<void(const ProgramFile&)>& take_;
  const MotionLimits limits_;
  const AxisLayout layout_;
  const PathTools tools_;
  const Digits digits_;
  std::vector<std::string> letters_;
  std::vector<Seam> seams_;
  ProgramNames names_;
  std::unique_ptr<PartWriter> writer_;
  std::vector<ProgramPlace> places_;  // of the part, its start first
  std::vector<StopTime> times_;       // of the moves to the others
  std::optional<PartStock> stock_;
  ProgramReport report_;
};

}  // namespace

ProgramReport make_program(const PlanPath& path, const Cell& cell, const ProgramDemands& demands,
                           const std::function<void(const ProgramFile&)>& take) {
  check_program_name(demands.name);
  check_demands(demands.motion);
  if (demands.part_bytes && *demands.part_bytes == 0)
    throw InputError("part_invalid", "a part of 0 bytes says nothing: give --part-bytes 1000 or more");
  if (demands.part_keyframes && *demands.part_keyframes == 0)
    throw InputError("part_invalid", "a part of 0 keyframes does nothing: give --part-keyframes 1 or more");
  const Chain chain = cell.chain();
  check_cell(path, chain, cell);
  if (path.size() < 2) throw InputError("part_invalid", "the plan moves nothing: there is no program to write");
  if (demands.dialect == Dialect::ros2) {
    if (demands.part_keyframes || demands.part_bytes || demands.stock_files)
      throw InputError("part_invalid",
                       "a ROS trajectory goes on between keyframes and has no parts: leave out --part-keyframes, "
                       "--part-bytes and --stock-files");
    return write_ros2(path, cell, demands, take);
  }
  return ProgramMaker(path, cell, chain, demands, take).run();
}

}  // namespace sculpt
