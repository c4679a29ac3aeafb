#include "core/collision/bubble.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.hpp"
#include "core/collision/scene.hpp"
#include "core/collision/shape/motion_bound.hpp"
#include "core/collision/shape/shape_contact.hpp"
#include "tests/core/base/cases.hpp"
#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/collision/shape/random_shapes.hpp"
#include "tests/core/collision/small_arm.hpp"

namespace sculpt {
namespace {

Configuration any_configuration(const Chain& chain, Random& random) {
  Configuration q(chain.dof());
  for (Eigen::Index c = 0; c < q.size(); ++c) q[c] = random.between(chain.lower()[c], chain.upper()[c]);
  return q;
}

bool is_of_links(Contact contact) {
  return contact == Contact::link_link || contact == Contact::link_material;
}

/// Many bubbles, each tried at random places that it says it holds.
void expect_held_is_free(const Cell& cell, int seeds, double widest) {
  const Grid grid = cell.grid(8);
  const Scene scene(cell, grid, VoxelSet(8, true));
  int held = 0, refused = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Configuration q = any_configuration(scene.chain(), random);
    for (int more = 50; more > 0 && is_of_links(scene.contact_at(q)); --more)
      q = any_configuration(scene.chain(), random);
    const Configuration half = Configuration::Constant(q.size(), random.between(0.001, widest));
    const JointBox box{q - half, q + half};
    Scene::Pairs pairs = random.unit() < 0.5 ? scene.pairs() : scene.pairs_in(box);
    const Bubble bubble = scene.bubble(q, box, {}, scene.full_stock(), pairs);
    if (bubble.empty()) continue;
    for (int place = 0; place < 40; ++place) {
      Configuration other = q;
      for (Eigen::Index c = 0; c < q.size(); ++c) other[c] += random.between(-1, 1) * half[c];
      if (!scene.chain().within_limits(other)) continue;
      if (!bubble.holds(other)) {
        ++refused;
        continue;
      }
      ++held;
      // The tool comes first in contact_at, and is not the bubble's matter where the material or the table is in its
      // way.
      const Contact contact = scene.contact_at(other);
      if (contact == Contact::tool_material) continue;
      if (!is_of_links(contact)) continue;
      const std::string what = scene.describe_contact(other);
      EXPECT_NE(what.find("the tool"), std::string::npos) << what;
    }
  }
  EXPECT_GT(held, 5 * seeds / 4);
  EXPECT_GT(refused, seeds / 20) << "no bubble ends anywhere";
}

TEST(Bubble, WhatASmallArmsBubblesHoldIsFree) {
  expect_held_is_free(make_test_cell(), 400, 0.3);
}

TEST(Bubble, WhatThePandasBubblesHoldIsFree) {
  expect_held_is_free(shipped_cell("panda-turntable"), cases(300), 0.15);
}

/// The small arm with links of triangles: a fore arm that is bent like a bow, a nose with a rough skin.
Cell make_mesh_cell() {
  Cell cell = make_test_cell();
  Random random(7);
  const auto set = [&](const char* link, std::shared_ptr<const Mesh> mesh, const Vec3& at) {
    Shape shape;
    shape.kind = ShapeKind::mesh;
    shape.mesh = std::move(mesh);
    shape.pose.translation() = at;
    cell.robot.links[static_cast<std::size_t>(cell.robot.find_link(link))].shapes = {shape};
  };
  auto bow = std::make_shared<Mesh>();
  constexpr int steps = 24;
  for (int step = 0; step <= steps; ++step) {
    const double part = static_cast<double>(step) / steps, out = 0.12 * std::sin(std::numbers::pi * part);
    for (const Vec3& corner : {Vec3(0.02, 0.02, 0), Vec3(-0.02, 0.02, 0), Vec3(0, -0.02, 0)})
      bow->vertices.push_back(corner + Vec3(-out, 0, 0.32 * part));
  }
  for (std::uint32_t step = 0; step < steps; ++step)
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t a = 3 * step + side, b = 3 * step + (side + 1) % 3;
      bow->triangles.push_back({a, b, a + 3});
      bow->triangles.push_back({b, b + 3, a + 3});
    }
  set("fore", bow, Vec3::Zero());
  auto skin = std::make_shared<Mesh>();
  for (int t = 0; t < 60; ++t) {
    const Vec3 at = 0.03 * random_direction(random);
    for (int corner = 0; corner < 3; ++corner) skin->vertices.push_back(at + random_vector(random, 0.008));
    const auto first = static_cast<std::uint32_t>(3 * t);
    skin->triangles.push_back({first, first + 1, first + 2});
  }
  set("nose", skin, Vec3::Zero());
  return cell;
}

// FCL, which has no part in bubbles, looks at the shapes themselves.
TEST(Bubble, WhatTheBubblesOfMeshLinksHoldIsFreeAsFclSeesIt) {
  const Cell cell = make_mesh_cell();
  const Chain chain = cell.chain();
  const Grid grid = cell.grid(8);
  const Scene scene(cell, grid, VoxelSet(8, true));
  Shape stock;
  stock.sides_m = Vec3::Constant(grid.n * grid.voxel_m);
  stock.pose.translation() = grid.origin_m + stock.sides_m / 2;
  std::vector<LinkShape> shapes;
  for (std::size_t link = 0; link < cell.robot.links.size(); ++link)
    for (const Shape& shape : cell.robot.links[link].shapes) shapes.emplace_back(static_cast<int>(link), shape);
  const LinkShape block(cell.stock_link, stock);
  const LinkPairs pairs = find_link_pairs(cell);
  std::vector<ShapeContact> contacts;
  for (const LinkShape& first : shapes) {
    if (first.link != cell.stock_link && first.link != 0) contacts.emplace_back(chain, first, block);
    for (const LinkShape& second : shapes)
      if (std::ranges::any_of(pairs.checked, [&](const CheckedLinks& checked) {
            return checked.links == LinkPair(first.link, second.link);
          }))
        contacts.emplace_back(chain, first, second);
  }
  int held = 0, touching = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Configuration q = any_configuration(chain, random);
    const Configuration half = Configuration::Constant(q.size(), random.between(0.001, 0.3));
    std::vector<Configuration> wanted;
    for (int corner = 0; corner < 4; ++corner) {
      wanted.push_back(q);
      for (Eigen::Index c = 0; c < q.size(); ++c) wanted.back()[c] += random.between(-1, 1) * half[c];
    }
    Scene::Pairs open = scene.pairs();
    const Bubble bubble = scene.bubble(q, {q - half, q + half}, wanted, scene.full_stock(), open);
    if (bubble.empty()) continue;
    for (const Configuration& corner : wanted) EXPECT_TRUE(bubble.holds(corner));
    for (int place = 0; place < 20; ++place) {
      const double a = random.unit(), b = random.unit();
      Configuration other = a * wanted[0] + (1 - a) * (b * wanted[1] + (1 - b) * wanted[2]);
      if (place % 2 == 0)
        for (Eigen::Index c = 0; c < q.size(); ++c) other[c] = q[c] + random.between(-1, 1) * half[c];
      if (!bubble.holds(other) || !chain.within_limits(other)) continue;
      ++held;
      for (const ShapeContact& contact : contacts) EXPECT_FALSE(contact.touch(other, 0));
    }
    touching += std::ranges::any_of(contacts, [&](const ShapeContact& contact) { return contact.touch(q, 0); });
  }
  EXPECT_GT(held, 1000);
  EXPECT_EQ(touching, 0) << "at the centre of a bubble";
}

/// A boom that swings, and on it a slide that ends short of a post.
Cell make_slide_cell() {
  CellFiles files;
  files.name = "slide";
  files.cell_json = R"({"urdf": "slide.urdf",
    "stock": {"link": "base", "size_m": 0.1, "origin_m": [-1, -0.05, 0]},
    "tool": {"link": "nose", "stickout_m": 0.1, "ball_radius_voxels": 0.45, "shank_radius_voxels": 0.4},
    "home": {"swing": 0, "slide": 0.2}})";
  files.files["slide.urdf"] = R"(<robot name="slide">
    <link name="base"><collision><origin xyz="0.7 0 0"/><geometry><sphere radius="0.02"/></geometry></collision></link>
    <link name="boom"/>
    <joint name="swing" type="revolute"><parent link="base"/><child link="boom"/><axis xyz="0 0 1"/>
      <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
    <link name="nose"><collision><geometry><sphere radius="0.03"/></geometry></collision></link>
    <joint name="slide" type="prismatic"><parent link="boom"/><child link="nose"/><axis xyz="1 0 0"/>
      <limit lower="0.1" upper="0.5" effort="1" velocity="1"/></joint>
  </robot>)";
  return parse_cell(files);
}

// Bounds on a motion take a slide to be within its limits: farther out the same turn carries it faster.
TEST(Bubble, SaysNothingBeyondTheLimitsOfASlide) {
  const Cell cell = make_slide_cell();
  const Scene scene(cell, cell.grid(8), VoxelSet(8, true));
  const auto box = [](double low, double high) {
    return JointBox{Configuration{{-0.01, low}}, Configuration{{0.01, high}}};
  };
  Scene::Pairs pairs = scene.pairs();
  const Bubble bubble = scene.bubble(Configuration{{0, 0.45}}, box(0.4, 0.6), {}, scene.full_stock(), pairs);
  EXPECT_TRUE(bubble.holds(Configuration{{0, 0.5}}));
  EXPECT_FALSE(bubble.holds(Configuration{{0, 0.51}}));
}

TEST(Bubble, WhatTouchesOnlyBeyondTheLimitsOfASlideIsNoPair) {
  const Cell cell = make_slide_cell();
  const Scene scene(cell, cell.grid(8), VoxelSet(8, true));
  const auto box = [](double low, double high) {
    return JointBox{Configuration{{-0.1, low}}, Configuration{{0.1, high}}};
  };
  EXPECT_EQ(scene.pairs().size(), 2u) << "the nose with the post, and with the material";
  EXPECT_TRUE(scene.pairs_in(box(0.1, 0.9)).empty());
  EXPECT_TRUE(scene.pairs_in(box(0.6, 0.9)).empty());
}

TEST(Bubble, AnEmptyOneHoldsNothing) {
  EXPECT_TRUE(Bubble().empty());
  EXPECT_FALSE(Bubble().holds(Configuration::Zero(3)));
}

TEST(Bubble, RelativeTwistsAreTheDifferencesOfPoses) {
  for (const SampleChain& sample : {arm_on_rail(), mimic_machine()}) {
    SCOPED_TRACE(sample.title);
    const Chain chain = sample.chain();
    const auto links = static_cast<int>(chain.robot().links.size());
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      const Configuration q = random_configuration(chain, random, 0.1);
      std::vector<Frame> here, there;
      chain.link_poses(q, here);
      for (int fixed = 0; fixed < links; ++fixed)
        for (int moving = 0; moving < links; ++moving) {
          const auto twist = relative_twist(chain, find_drives(chain, fixed, moving), here);
          const Configuration turn = turn_bound(chain, fixed, moving), reach = motion_bound(chain, fixed, moving, 0.1);
          for (int c = 0; c < chain.dof(); ++c) {
            const double step = 1e-6;
            chain.link_poses(q + step * Configuration::Unit(chain.dof(), c), there);
            const auto in_fixed = [&](const std::vector<Frame>& poses) {
              return poses[static_cast<std::size_t>(fixed)].inverse() * poses[static_cast<std::size_t>(moving)] *
                     Vec3(0.1, 0, 0);
            };
            const Vec3 moved =
                here[static_cast<std::size_t>(fixed)].linear() * (in_fixed(there) - in_fixed(here)) / step;
            const Vec3 point = here[static_cast<std::size_t>(moving)] * Vec3(0.1, 0, 0);
            const Vec3 turning = twist.col(c).tail<3>(), velocity = Vec3(twist.col(c).head<3>()) + turning.cross(point);
            EXPECT_LT((moved - velocity).norm(), 1e-4);
            EXPECT_LE(turning.norm(), turn[c] + 1e-12);
            EXPECT_LE(velocity.norm(), reach[c] + 1e-9);
          }
        }
    }
  }
}

}  // namespace
}  // namespace sculpt
