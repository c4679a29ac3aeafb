// What the daemon starts with --run-job and --check-job, with the fake planner in the place of the real one.
#include <string_view>

#include "server/isolated_check.hpp"
#include "server/isolated_run.hpp"
#include "tests/server/fake_planner.hpp"

int main(int, char** arguments) {
  sculpt::FakePlanner fake;
  const bool check = std::string_view(arguments[1]) == sculpt::check_job_option;
  return check ? sculpt::run_isolated_check(fake.planner()) : sculpt::run_isolated_job(fake.planner());
}
