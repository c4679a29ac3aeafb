// What the daemon starts with --run-job, --check-job, --check-cell, --replay-job, --time-job, --program-job and
// --machined-job, with the fake planner in the place of the real one.
#include <string_view>

#include "server/results/isolated_program.hpp"
#include "server/results/isolated_timing.hpp"
#include "server/results/machined_files.hpp"
#include "server/run/isolated_check.hpp"
#include "server/run/isolated_examination.hpp"
#include "server/run/isolated_replay.hpp"
#include "server/run/isolated_run.hpp"
#include "tests/server/fake_planner.hpp"

int main(int, char** arguments) {
  sculpt::server::FakePlanner fake;
  const std::string_view mode = arguments[1];
  if (mode == sculpt::server::check_job_option) return sculpt::server::run_isolated_check(fake.planner());
  if (mode == sculpt::server::check_cell_option) return sculpt::server::run_isolated_examination(fake.planner());
  if (mode == sculpt::server::replay_job_option) return sculpt::server::run_isolated_replay(fake.planner());
  if (mode == sculpt::server::time_job_option) return sculpt::server::run_isolated_timing(fake.planner());
  if (mode == sculpt::server::program_job_option) return sculpt::server::run_isolated_program(fake.planner());
  if (mode == sculpt::server::machined_job_option) return sculpt::server::run_isolated_machined(fake.planner());
  return sculpt::server::run_isolated_job(fake.planner());
}
