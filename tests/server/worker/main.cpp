// What the daemon starts with --run-job, with the fake planner in the place of the real one.
#include "server/isolated_run.hpp"
#include "tests/server/fake_planner.hpp"

int main() {
  sculpt::FakePlanner fake;
  return sculpt::run_isolated_job(fake.planner());
}
