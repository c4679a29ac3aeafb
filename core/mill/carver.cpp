#include "core/mill/carver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/mill/drive/hop.hpp"
#include "core/mill/drive/hub.hpp"
#include "core/mill/map/fixtures.hpp"

namespace sculpt {
namespace {

/// Beyond the stock the tip needs room for its cutter and to turn around in.
constexpr double room_beside_m = 8e-3, room_around_m = 0.05;
/// Tips are whole numbers of quanta.
constexpr double same_tip_m = 1e-6;
/// Nails: so many on a square of the finest stepover, but no more and no fewer than these.
constexpr double nails_a_stepover = 3;
constexpr std::size_t fewest_nails = 20000, max_nails = 900000;

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm() / 2;
  return area;
}

/// No longer than it is wide, and one more where the voxels are that coarse.
double voxels_of_chip(const MillTool& tool, const Grid& grid) {
  return 1 + tool.max_depth_m * std::pow(tool.max_width_m, 2) / std::pow(grid.voxel_m, 3);
}

Eigen::AlignedBox3d box_around(const VoxelSet& voxels, const Grid& grid) {
  Eigen::AlignedBox3d box;
  for_each_voxel(voxels, [&](Voxel v) {
    for (const double corner : {0.0, 1.0})
      box.extend(grid.origin_m + grid.voxel_m * (Vec3(v.i, v.j, v.k) + Vec3::Constant(corner)));
  });
  return box;
}

Nails make_nails(const MillJob& job, std::uint64_t seed) {
  double finest_m2 = std::numeric_limits<double>::infinity();
  for (const MillTool& tool : job.tools)
    finest_m2 = std::min(finest_m2, std::pow(job.wishes.stepover_m(tool.cutter.radius_m), 2));
  const double wanted = nails_a_stepover * area_of(job.part) / finest_m2;
  const auto count =
      static_cast<std::size_t>(std::clamp(wanted, static_cast<double>(fewest_nails), static_cast<double>(max_nails)));
  return {job.part, job.voxels, job.grid, count, seed};
}

}  // namespace

Carver::Carver(const MillJob& job, const Emit& emit, const RunContext& run)
    : job_(job),
      run_(run),
      stock_(job.voxels.stock, job.grid),
      pieces_(job.voxels),
      nails_(make_nails(job, run.seed)),
      to_remove_(job.voxels.stock.size() - job.voxels.keep.size()),
      stock_box_(box_around(job.voxels.stock, job.grid)),
      fixtures_(fixture_mesh(job.cell)),
      emit_([this, &emit](std::vector<Keyframe> keyframes) {
        count(keyframes);
        emit(std::move(keyframes));
      }),
      arm_(job.home, job.change, emit_, run) {
  double max_radius_m = 0;
  for (const MillTool& tool : job.tools) max_radius_m = std::max(max_radius_m, tool.cutter.radius_m);
  around_ = grid_around(job.grid, max_radius_m + room_around_m);
}

void Carver::take_tool(std::size_t number) {
  const MillTool& tool = job_.tools[number];
  auto held = make_held(tool);
  if (meter_) done_.push_back(meter_->figures());
  ToolFigures none;
  none.name = tool.name;
  meter_ = make_meter(tool, std::move(none));
  arm_.take_tool(static_cast<int>(number), *held);  // the one before is there until then
  held_ = std::move(held);
}

std::size_t Carver::go_on(MillStart start) {
  const std::size_t number = start.memory.tools.size() - 1;
  cut_again(job_, start.cuts, stock_, nails_, run_);
  removed_ = job_.voxels.stock.size() - stock_.left().voxels().size();
  run_.watch.step(Stage::plan, removed_, to_remove_);
  for (std::size_t nail = 0; nail < nails_.size(); ++nail)
    if (start.memory.reachable[nail] != 0) nails_.mark_reachable(nail);
  done_ = std::move(start.memory.tools);
  meter_ = make_meter(job_.tools[number], std::move(done_.back()));
  done_.pop_back();
  held_ = make_held(job_.tools[number]);
  arm_.go_on(*held_, std::move(start.memory.arm));
  return number;
}

std::vector<ToolFigures> Carver::figures() const {
  std::vector<ToolFigures> figures = done_;
  figures.push_back(meter_->figures());
  return figures;
}

std::unique_ptr<HeldTool> Carver::make_held(const MillTool& tool) {
  auto held = std::make_unique<HeldTool>(job_.cell, tool, job_.grid, around_);
  held->see(cells_of(standing(), job_.grid, around_));
  return held;
}

std::unique_ptr<ToolMeter> Carver::make_meter(const MillTool& tool, ToolFigures figures) const {
  return std::make_unique<ToolMeter>(tool, job_.grid.voxel_m, std::move(figures));
}

void Carver::count(const std::vector<Keyframe>& keyframes) {
  for (const Keyframe& keyframe : keyframes) {
    const MillStep& step = *keyframe.mill;
    std::optional<Vec3> tip;
    if (step.is_placed()) tip = point_of(step.tip);
    meter_->count(keyframe, tip && tip_ ? (*tip - *tip_).norm() : 0);
    tip_ = tip;
  }
  run_.watch.step(Stage::plan, removed_, to_remove_);
}

std::unique_ptr<Site> Carver::make_site(std::size_t direction, const SiteMargins& margins, double step_m) const {
  const ToolFrame frame(mill_directions()[direction]);
  const Assembly& assembly = held_->assembly();
  // Wherever the tip goes, all is known that is below what the tool carries.
  const double margin = tool().cutter.radius_m + room_beside_m + assembly.radius_m() + 2 * step_m;
  return std::make_unique<Site>(frame, lattice_over(frame, stock_box_.min(), stock_box_.max(), margin, step_m),
                                assembly, job_.part, fixtures_, margins);
}

double Carver::bottom(const ToolFrame& frame) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner)
    lowest = std::min(lowest, frame.of(stock_box_.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))).z());
  return lowest;
}

bool Carver::enter(std::size_t number, const Site& site, const std::vector<Vec3>& places) {
  held_->see(cells_of(standing(), job_.grid, around_));
  struct Way {
    const PostureField* field;
    std::unique_ptr<const ReachFloor> floor;
    std::ptrdiff_t reached;
  };
  std::vector<Way> ways;
  for (const auto& field : held_->fields(mill_directions()[number], job_.home, run_)) {
    auto floor = std::make_unique<const ReachFloor>(*field, around_, site, site.top() + room_around_m, run_.helpers);
    const auto reached =
        std::ranges::count_if(places, [&](const Vec3& place) { return floor->allows(site.frame().of(place)); });
    if (reached > 0) ways.push_back({field.get(), std::move(floor), reached});
  }
  std::ranges::stable_sort(ways, std::ranges::greater{}, &Way::reached);
  return std::ranges::any_of(ways, [&](Way& way) {
    floor_ = std::move(way.floor);
    return hold(number, site, *way.field);
  });
}

bool Carver::hold(std::size_t number, const Site& site, const PostureField& field) {
  const auto goes_down = [&](const Vec3& from, const Vec3& to) {
    const MillStroke down{site.frame().point(to), false, air_stray_m};
    return follow(*held_, field, static_cast<int>(number), site.frame().point(from), {down}).strokes() == 1;
  };
  const std::optional<Vec3> hub = find_hub(site, *floor_, field, around_, room_around_m, goes_down);
  if (!hub || !arm_.hold(field, static_cast<int>(number), site.frame().point(*hub))) return false;
  hub_ = *hub;
  axis_ = site.frame().w;
  trail_.clear();
  sweeps_.emplace(tool().cutter, mill_directions()[number], job_.wishes.stray_m(), job_.grid.voxel_m);
  return true;
}

void Carver::draw_back(const Site& site) {
  bool may_hop = true;
  while ((tip(site) - hub_).norm() > same_tip_m) {
    for (const double min_height : {-std::numeric_limits<double>::infinity(), hub_.z()}) {
      if (!may_hop) break;
      std::vector<MillStroke> strokes;
      hop(site, tip(site), hub_, min_height, job_.wishes.stray_m(), strokes);
      if (FollowedMill followed = arm_.try_strokes(strokes); followed.strokes() == strokes.size()) {
        remove(followed);  // it ends before what would come loose
        may_hop = followed.strokes() == strokes.size();
        go(std::move(followed));
        if (may_hop) return settle();
      }
    }
    if (trail_.empty()) throw InputError("no_transit", "the arm cannot draw back along the tool's axis");
    // Back to where the tip was before, and try from there.
    const Vec3 before = trail_.back();
    trail_.pop_back();
    const std::vector<Vec3> rest = trail_;
    FollowedMill back = arm_.try_strokes({{before, true, job_.wishes.stray_m()}});
    remove(back);
    go(std::move(back));
    trail_ = rest;
  }
  settle();
}

std::size_t Carver::carry_out(const std::vector<MillStroke>& strokes) {
  FollowedMill followed = arm_.try_strokes(strokes);
  run_.helpers.for_each_index(3, [&](std::size_t part) {
    if (part == 0)
      remove(followed);
    else
      part == 1 ? clear_due() : cut_nails_due();
  });
  due_.clear();
  const std::size_t done = followed.strokes();
  // Nobody needs to go over to where nothing is cut.
  std::size_t useful = done;
  while (done < strokes.size() && useful > 0 && !strokes[useful - 1].cut) --useful;
  followed.cut_to(useful);
  go(std::move(followed));
  return done;
}

/// What is removed is known.
void Carver::go(FollowedMill followed) {
  QuantaPoint at = quanta_of(*arm_.tip());
  for (const Keyframe& keyframe : followed.keyframes) {
    const QuantaPoint from = std::exchange(at, keyframe.mill->tip);
    trail_.push_back(point_of(from));
    if (!keyframe.cut) continue;
    due_.push_back({from, at});
    ++cuts_;
  }
  arm_.commit(std::move(followed));
}

void Carver::clear_due() {
  for (const CutEdge& edge : due_) stock_.clear(*sweeps_, edge.from, edge.to);
}

void Carver::cut_nails_due() {
  for (const CutEdge& edge : due_) cut_nails(nails_, tool().cutter, axis_, stray_m(), edge);
}

void Carver::settle() {
  if (due_.empty()) return;
  run_.helpers.for_each_index(2, [&](std::size_t part) { part == 0 ? clear_due() : cut_nails_due(); });
  due_.clear();
}

const VoxelSet& Carver::standing() {
  settle();
  return stock_.standing();
}

/// Of the stock, by one stroke after the other, up to the first one that would bring a piece loose.
void Carver::remove(FollowedMill& followed) {
  QuantaPoint at = quanta_of(*arm_.tip());
  std::size_t next = 0;
  SweptSet::Taken by_stroke, by_cut;
  for (std::size_t stroke = 0; stroke < followed.strokes(); ++stroke) {
    std::uint64_t removed = 0;
    by_stroke.clear();
    for (; next < followed.ends[stroke]; ++next) {
      Keyframe& keyframe = followed.keyframes[next];
      const QuantaPoint from = std::exchange(at, keyframe.mill->tip);
      if (!keyframe.cut) continue;
      by_cut.clear();
      removed += keyframe.mill->removed = stock_.remove(*sweeps_, from, at, by_cut);
      by_stroke.insert(by_stroke.end(), by_cut.begin(), by_cut.end());
      if (!pieces_.frees(stock_.left().voxels(), by_cut, voxels_of_chip(tool(), job_.grid))) continue;
      stock_.undo_remove(by_stroke);
      return followed.cut_to(stroke);
    }
    removed_ += removed;
  }
}

}  // namespace sculpt
