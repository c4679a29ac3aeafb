// A store in a folder of its own, to be opened again and again.
#pragma once

#include <gtest/gtest.h>

#include "server/store/job_store.hpp"
#include "tests/server/temp_folder.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {

class JobStoreTest : public testing::Test {
 protected:
  std::string add(const std::string& key = {}, int priority = 0, const std::string& spec = "{}") {
    NewJob job;
    job.key = key;
    job.schedule.priority = priority;
    job.spec = spec;
    job.cell_bundle = "bundle";
    job.memory_bytes = 1;
    return store->submit(job).job.id;
  }
  void reopen() {
    store.reset();
    store = open_test_store(file());
  }
  std::filesystem::path file() const { return folder.path() / "sculptd.db"; }
  JobState state(const std::string& job) { return store->find(job)->state; }

  TempFolder folder;
  std::unique_ptr<JobStore> store = open_test_store(file());
};

}  // namespace sculpt::server
