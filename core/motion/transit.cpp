#include "core/motion/transit.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <cmath>

#include "core/base/random.hpp"
#include "core/trajectory/quantum.hpp"

namespace sculpt {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Space = ob::RealVectorStateSpace;

Configuration configuration_of(const ob::State* state, const Chain& chain) {
  const Eigen::Map<const Eigen::VectorXd> q(state->as<Space::StateType>()->values, chain.dof());
  return rounded(q, chain.lower(), chain.upper());
}

void set_state(ob::State* state, const Configuration& q) {
  Eigen::Map<Eigen::VectorXd>(state->as<Space::StateType>()->values, q.size()) = q;
}

/// Uniform samples from a local seed: OMPL's own generators share a process-wide one.
class SeededSampler : public ob::StateSampler {
 public:
  SeededSampler(const ob::StateSpace* space, std::uint64_t seed) : ob::StateSampler(space), random_(seed) {}

  void sampleUniform(ob::State* state) override {
    const auto& bounds = space_->as<Space>()->getBounds();
    for (unsigned i = 0; i < space_->getDimension(); ++i)
      state->as<Space::StateType>()->values[i] = random_.between(bounds.low[i], bounds.high[i]);
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    for (unsigned i = 0; i < space_->getDimension(); ++i)
      state->as<Space::StateType>()->values[i] =
          near->as<Space::StateType>()->values[i] + random_.between(-distance, distance);
    space_->enforceBounds(state);
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    for (unsigned i = 0; i < space_->getDimension(); ++i) {
      const double radius = std::sqrt(-2 * std::log(1 - random_.unit()));
      state->as<Space::StateType>()->values[i] =
          mean->as<Space::StateType>()->values[i] + deviation * radius * std::cos(2 * M_PI * random_.unit());
    }
    space_->enforceBounds(state);
  }

 private:
  Random random_;
};

/// Tree edges are certified, not sampled, and on the rounded values that leave the planner.
class CertifiedMotion : public ob::MotionValidator {
 public:
  CertifiedMotion(const ob::SpaceInformationPtr& space, const Scene& scene)
      : ob::MotionValidator(space), scene_(scene) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const Chain& chain = scene_.chain();
    const Configuration first = configuration_of(from, chain), last = configuration_of(to, chain);
    // Most of those that are not free are seen so at little cost.
    return scene_.contact_at(last) == Contact::none && scene_.contact_at((first + last) / 2) == Contact::none &&
           scene_.certify(first, last) == Contact::none;
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    const bool valid = checkMotion(from, to);
    if (!valid) {
      last_valid.second = 0;
      if (last_valid.first != nullptr) si_->copyState(last_valid.first, from);
    }
    return valid;
  }

 private:
  const Scene& scene_;
};

ob::SpaceInformationPtr make_space(const Scene& scene, std::uint64_t seed) {
  const Chain& chain = scene.chain();
  auto space = std::make_shared<Space>(static_cast<unsigned>(chain.dof()));
  ob::RealVectorBounds bounds(static_cast<unsigned>(chain.dof()));
  for (int i = 0; i < chain.dof(); ++i) {
    bounds.setLow(static_cast<unsigned>(i), chain.lower()[i]);
    bounds.setHigh(static_cast<unsigned>(i), chain.upper()[i]);
  }
  space->setBounds(bounds);
  space->setStateSamplerAllocator(
      [seed](const ob::StateSpace* of) { return std::make_shared<SeededSampler>(of, seed); });
  auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker([&scene](const ob::State* state) {
    return scene.contact_at(configuration_of(state, scene.chain())) == Contact::none;
  });
  information->setMotionValidator(std::make_shared<CertifiedMotion>(information, scene));
  information->setup();
  return information;
}

std::vector<Configuration> plan_rrt(const Scene& scene, const Configuration& from, const Configuration& to,
                                    std::uint64_t seed, const std::stop_token& stop, const TransitSettings& settings) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const ob::SpaceInformationPtr information = make_space(scene, seed);
  auto problem = std::make_shared<ob::ProblemDefinition>(information);
  ob::ScopedState<> start(information), goal(information);
  set_state(start.get(), from);
  set_state(goal.get(), to);
  problem->setStartAndGoalStates(start, goal);
  og::RRTConnect planner(information);
  planner.setRange(settings.range_rad);
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
  planner.setProblemDefinition(problem);
  planner.setup();
  int iterations = 0;
  const ob::PlannerTerminationCondition end(
      [&] { return ++iterations > settings.max_iterations || stop.stop_requested(); });
  if (planner.solve(end) != ob::PlannerStatus::EXACT_SOLUTION) return {};
  std::vector<Configuration> path;
  for (const ob::State* state : problem->getSolutionPath()->as<og::PathGeometric>()->getStates())
    path.push_back(configuration_of(state, scene.chain()));
  return path;
}

}  // namespace

std::vector<Configuration> shorten(const Scene& scene, const std::vector<Configuration>& path) {
  if (path.size() < 3) return path;
  std::vector<Configuration> kept{path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t next = path.size() - 1;
    while (next > at + 1 && scene.certify(path[at], path[next]) != Contact::none) next = at + (next - at + 1) / 2;
    kept.push_back(path[next]);
    at = next;
  }
  return kept;
}

Transit plan_transit(const Scene& scene, const Configuration& from, const Configuration& to, std::uint64_t seed,
                     const std::stop_token& stop, const TransitSettings& settings) {
  if (scene.certify(from, to) == Contact::none) return {{from, to}, false};
  return {shorten(scene, plan_rrt(scene, from, to, seed, stop, settings)), true};
}

}  // namespace sculpt
