#include "tests/core/search/replay.hpp"

#include "core/base/random.hpp"

namespace sculpt {
namespace {

std::string text(Voxel v) {
  return std::to_string(v.i) + " " + std::to_string(v.j) + " " + std::to_string(v.k);
}

/// The unit step from a to b if they lie on one line along an axis.
bool straight(Voxel a, Voxel b, Voxel& step) {
  const Voxel way = b - a;
  const int length = l1(a, b);
  if ((way.i != 0) + (way.j != 0) + (way.k != 0) > 1) return false;
  step = length == 0 ? Voxel{} : Voxel{way.i / length, way.j / length, way.k / length};
  return true;
}

class Replay {
 public:
  explicit Replay(const VoxelGrid& voxels)
      : voxels_(voxels), bounds_{voxels.n(), 1, Vec3::Zero()}, at_(translating_entry(voxels.n())) {
    result_.removed = VoxelSet(voxels.n());
  }

  Replayed run(const std::vector<VoxelRun>& runs) {
    for (std::size_t r = 0; r < runs.size() && result_.fault.empty(); ++r) {
      result_.fault = runs[r].cut ? cut(runs[r]) : travel(runs[r]);
      if (result_.fault.empty() && r > 0 && joins(runs[r - 1], runs[r]))
        result_.fault = "should be one with the run before";
      if (!result_.fault.empty()) result_.fault = "run " + std::to_string(r) + ": " + result_.fault;
    }
    if (result_.fault.empty() && at_ != translating_entry(voxels_.n())) result_.fault = "ends at " + text(at_);
    return result_;
  }

 private:
  bool is_air(Voxel v) const {
    const int n = voxels_.n();
    if (v.i < -1 || v.j < -1 || v.k < 0 || v.i > n || v.j > n || v.k > n) return false;
    return !bounds_.contains(v) || voxels_.label(v) == Label::air || result_.removed.contains(v);
  }

  std::string cut(const VoxelRun& run) {
    Voxel step;
    if (!straight(run.first, run.last, step)) return "a cut that is not straight";
    if (l1(at_, run.first) != 1) return "a cut that starts at " + text(run.first) + ", the robot is at " + text(at_);
    for (Voxel v = run.first;; v = v + step) {
      if (!bounds_.contains(v)) return "cuts outside the grid at " + text(v);
      if (voxels_.label(v) != Label::remove) return "cuts what is not to be removed at " + text(v);
      if (result_.removed.contains(v)) return "cuts twice at " + text(v);
      result_.removed.insert(v);
      ++result_.cut;
      at_ = v;
      if (v == run.last) return "";
    }
  }

  std::string travel(const VoxelRun& run) {
    Voxel step;
    if (run.first != at_) return "a travel that starts at " + text(run.first) + ", the robot is at " + text(at_);
    if (run.first == run.last || !straight(run.first, run.last, step)) return "a travel without length or not straight";
    while (at_ != run.last) {
      at_ = at_ + step;
      ++result_.travelled;
      if (!is_air(at_)) return "travels through material at " + text(at_);
    }
    return "";
  }

  /// Whether one straight run could do what these two do.
  static bool joins(const VoxelRun& a, const VoxelRun& b) {
    if (a.cut != b.cut) return false;
    Voxel before, between, after;
    straight(a.first, a.last, before);
    straight(a.last, b.cut ? b.first : b.last, between);
    straight(b.first, b.last, after);
    return (before == Voxel{} || before == between) && (after == Voxel{} || after == between);
  }

  const VoxelGrid& voxels_;
  Grid bounds_;
  Voxel at_;
  Replayed result_;
};

void fill_box(VoxelSet& set, Random& random, bool value) {
  const double n = set.n();
  const auto number = [&](double top) { return static_cast<int>(random.between(0, top)); };
  const Voxel low{number(n), number(n), number(n)}, size{number(n), number(n), number(n)};
  for (int k = low.k; k < std::min(low.k + size.k, set.n()); ++k)
    for (int j = low.j; j < std::min(low.j + size.j, set.n()); ++j)
      for (int i = low.i; i < std::min(low.i + size.i, set.n()); ++i)
        value ? set.insert({i, j, k}) : set.erase({i, j, k});
}

void add_noise(VoxelSet& set, Random& random) {
  const double share = random.unit() * random.unit();
  for (int k = 0; k < set.n(); ++k)
    for (int j = 0; j < set.n(); ++j)
      for (int i = 0; i < set.n(); ++i)
        if (random.unit() < share) set.insert({i, j, k});
}

}  // namespace

Replayed replay(const VoxelGrid& voxels, const std::vector<VoxelRun>& runs) {
  return Replay(voxels).run(runs);
}

std::vector<VoxelRun> carve(const VoxelGrid& voxels) {
  std::vector<VoxelRun> runs;
  const Octree octree = build_octree(voxels, {});
  carve_translating(voxels, octree, build_block_graph(octree, {}), [&](const VoxelRun& run) { runs.push_back(run); },
                    {});
  return runs;
}

VoxelSet enclosed_by_flood(const VoxelGrid& voxels) {
  const int n = voxels.n();
  const Grid bounds{n, 1, Vec3::Zero()};
  VoxelSet enclosed(n), reached(n);
  std::vector<Voxel> stack;
  const auto visit = [&](Voxel v) {
    if (!bounds.contains(v) || reached.contains(v) || voxels.label(v) == Label::keep) return;
    reached.insert(v);
    stack.push_back(v);
  };
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (Voxel outer : {Voxel{0, a, b}, {n - 1, a, b}, {a, 0, b}, {a, n - 1, b}, {a, b, n - 1}}) visit(outer);
  while (!stack.empty()) {
    const Voxel v = stack.back();
    stack.pop_back();
    for (Voxel step : face_steps) visit(v + step);
  }
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (voxels.label({i, j, k}) == Label::remove && !reached.contains({i, j, k})) enclosed.insert({i, j, k});
  return enclosed;
}

VoxelGrid random_voxels(int n, std::uint64_t seed) {
  Random random(seed);
  VoxelGrid voxels{VoxelSet(n, true), VoxelSet(n)};
  const int boxes = static_cast<int>(random.between(0, 7));
  for (int b = 0; b < boxes; ++b) fill_box(voxels.keep, random, random.unit() < 0.75);
  if (random.unit() < 0.5) add_noise(voxels.keep, random);
  if (random.unit() < 0.5) {
    VoxelSet air(n);
    const int holes = static_cast<int>(random.between(1, 4));
    for (int h = 0; h < holes; ++h) fill_box(air, random, true);
    if (random.unit() < 0.3) add_noise(air, random);
    for (std::size_t w = 0; w < air.words().size(); ++w) {
      voxels.stock.words()[w] &= ~air.words()[w];
      voxels.keep.words()[w] &= ~air.words()[w];
    }
  }
  return voxels;
}

}  // namespace sculpt
