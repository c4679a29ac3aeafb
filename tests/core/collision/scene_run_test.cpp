// Machines of slides: runs certified at once, and what is settled beforehand.
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/collision/bubble.hpp"
#include "core/collision/scene.hpp"
#include "tests/core/base/cases.hpp"

namespace sculpt {
namespace {

constexpr int n = 8;

/// Three slides; the joint values are the ball's centre. A post stands beside the stock, which the spindle can meet.
Cell make_slides(bool shank) {
  CellFiles files;
  files.name = "slides";
  files.cell_json = std::string(R"({"urdf": "slides.urdf",
    "stock": {"link": "plate", "size_m": 0.08, "origin_m": [0, 0, 0]},
    "tool": {"link": "spindle", "stickout_m": 0.06, "ball_radius_voxels": 0.45, "shank_radius_voxels": )") +
                    (shank ? "0.4" : "0") + R"(},
    "home": {"x": 0.04, "y": 0.04, "z": 0.2}})";
  files.files["slides.urdf"] = R"(<robot name="slides">
    <link name="plate"><collision><origin xyz="0.04 0.04 -0.02"/><geometry><box size="0.3 0.3 0.04"/></geometry></collision>
      <collision><origin xyz="0.13 0.04 0.04"/><geometry><box size="0.02 0.02 0.08"/></geometry></collision></link>
    <link name="bridge"/>
    <joint name="x" type="prismatic"><parent link="plate"/><child link="bridge"/><axis xyz="1 0 0"/>
      <limit lower="-0.1" upper="0.2" effort="1" velocity="1"/></joint>
    <link name="carriage"/>
    <joint name="y" type="prismatic"><parent link="bridge"/><child link="carriage"/><axis xyz="0 1 0"/>
      <limit lower="-0.1" upper="0.2" effort="1" velocity="1"/></joint>
    <link name="quill"/>
    <joint name="z" type="prismatic"><parent link="carriage"/><child link="quill"/><axis xyz="0 0 1"/>
      <limit lower="-0.01" upper="0.3" effort="1" velocity="1"/></joint>
    <link name="spindle"><collision><origin xyz="0 0 -0.02"/><geometry><box size="0.05 0.05 0.04"/></geometry></collision></link>
    <joint name="nose" type="fixed"><parent link="quill"/><child link="spindle"/><origin xyz="0 0 0.06" rpy="3.141592653589793 0 0"/></joint>
  </robot>)";
  return parse_cell(files);
}

VoxelSet random_stock(Random& random) {
  VoxelSet standing(n, true);
  const double gone = random.unit();
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (random.unit() < gone) standing.erase({i, j, k});
  return standing;
}

VoxelLine random_run(Random& random) {
  const auto number = [&](int below) { return static_cast<int>(random.next() % static_cast<std::uint64_t>(below)); };
  const Voxel first{number(n), number(n), number(n)}, step = face_steps[static_cast<std::size_t>(number(6))];
  Voxel last = first;
  for (int more = number(n); more > 0 && Grid{n, 1, Vec3::Zero()}.contains(last + step); --more) last = last + step;
  return {first, last};
}

TEST(SceneRun, IsFreeOnlyWhereEachStepIs) {
  for (const bool shank : {false, true}) {
    const Cell cell = make_slides(shank);
    int at_once = 0, refused = 0, in_vain = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
      SCOPED_TRACE("shank " + std::to_string(shank) + ", seed " + std::to_string(seed));
      Random random(seed);
      const VoxelLine run = random_run(random);
      const Voxel way = sign(run.last - run.first);
      Scene scene(cell, cell.grid(n), random_stock(random));
      const Configuration from = scene.grid().centre(run.first - way), to = scene.grid().centre(run.last);
      const bool free = scene.certify_run(from, to, run);
      const int count = l1(run.first, run.last) + 1;
      bool each = true;
      for (int m = 0; m < count; ++m) {
        const auto at = [&](int part) { return Configuration(from + (to - from) * part / count); };
        const Voxel voxel = run.first + way * m;
        each = each && scene.certify(at(m), at(m + 1), voxel) == Contact::none;
        scene.remove(voxel);
      }
      ASSERT_LE(free, each);
      at_once += free;
      refused += !each;
      in_vain += each && !free;
    }
    EXPECT_GT(at_once, 300);
    EXPECT_GT(refused, 300);
    EXPECT_LT(in_vain, at_once / 5);  // upwards through air, above all
  }
}

TEST(Scene, SaysOfWhatIsSettledWhatItSaidBeforeOrThatItIsFree) {
  const Cell cell = make_slides(true);
  int free = 0, touching = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const VoxelSet standing = random_stock(random);
    const Scene plain(cell, cell.grid(n), standing);
    Scene settled(cell, cell.grid(n), standing);
    const auto within = [&](double by) {
      return Vec3(random.between(-by, by), random.between(-by, by), random.between(-by, by));
    };
    const Configuration middle = Vec3(0.06, 0.04, 0.06) + within(0.03), half = within(0.05).cwiseAbs();
    settled.settle({middle - half, middle + half});
    for (int edge = 0; edge < 20; ++edge) {
      const Configuration from = middle + half.cwiseProduct(within(1.1)), to = from + within(0.02);
      const Contact before = plain.certify(from, to), now = settled.certify(from, to);
      if (before == Contact::none) {
        ASSERT_EQ(now, Contact::none);
        ++free;
      }
      if (now != Contact::none) {
        ++touching;
        continue;
      }
      for (int sample = 0; sample <= 20; ++sample)
        ASSERT_EQ(plain.contact_at(from + (to - from) * sample / 20.0), Contact::none);
    }
  }
  EXPECT_GT(free, 300);
  EXPECT_GT(touching, 300);
}

}  // namespace
}  // namespace sculpt
