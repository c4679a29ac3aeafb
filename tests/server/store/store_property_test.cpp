// Random histories, played on the store and on the model of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/base/random.hpp"
#include "proto/error_codes.hpp"
#include "tests/server/store/store_model.hpp"
#include "tests/server/temp_folder.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {
namespace {

constexpr int histories = 30, steps = 150;

const std::vector<Ending> endings{{JobState::succeeded, {}, {}, {{"report", "json", 3, "def"}}, Cause::job},
                                  {JobState::failed, "no_transit", "there is no way", {}, Cause::job},
                                  {JobState::failed, "out_of_memory", "no memory", {}, Cause::fault},
                                  {JobState::failed, "planner_crashed", "signal 11", {}, Cause::crash}};

std::optional<JobState> refused_or(const std::function<JobState()>& act) {
  try {
    return act();
  } catch (const proto::ProtocolError& error) {
    EXPECT_EQ(error.code(), "wrong_state");
    return std::nullopt;
  }
}

class History {
 public:
  explicit History(std::uint64_t seed) : random_(seed) {
    rules_.isolate = seed % 5 == 0;
    rules_.memory_bytes = 10;
    rules_.max_jobs = 9;
    rules_.max_jobs_per_owner = 4;
    rules_.now_ms = [this] { return now_ms_; };
    open();
  }

  void play() {
    submit();
    for (int step = 0; step < steps && !testing::Test::HasFatalFailure(); ++step) {
      this->step();
      compare();
    }
    check_events();
    check_numbers();
  }

 private:
  void open() {
    store_.reset();
    rules_.queues = {default_queue};
    if (below(2) == 0) rules_.queues.emplace_back("large");
    store_ = open_test_store(folder_.path() / "db", rules_);
  }

  std::uint64_t below(std::uint64_t bound) { return random_.next() % bound; }
  std::string text(std::uint64_t ms) { return ms == 0 ? "" : utc_text(ms); }

  void submit() {
    NewJob job;
    job.schedule.priority = static_cast<int>(below(5)) - 2;
    const std::uint64_t not_before = below(4) == 0 ? now_ms_ + below(60'000) : 0;
    const std::uint64_t start_by = below(4) == 0 ? now_ms_ + 1 + below(120'000) : 0;
    job.schedule.not_before = text(not_before);
    job.schedule.start_by = text(start_by);
    job.memory_bytes = 1 + below(12);
    job.owner = std::vector<std::string>{"", "arm", "gantry"}[below(3)];
    if (below(3) == 0) job.schedule.queue = "large";
    const std::string refusal = model_.refusal_of(job.owner, job.schedule.queue);
    try {
      const std::string id = store_->submit(job).job.id;
      model_.submit(id, job, not_before, start_by);
      ASSERT_EQ(refusal, "");
    } catch (const proto::ProtocolError& error) {
      ASSERT_EQ(refusal, error.code());
    }
  }

  void step() {
    if (model_.jobs().empty()) return submit();
    const std::size_t chosen = below(model_.jobs().size());
    const std::string job = model_.jobs()[chosen].id;
    const int attempt = model_.jobs()[chosen].attempt - (below(8) == 0 ? 1 : 0);
    switch (below(16)) {
      case 0:
      case 1:
        return submit();
      case 2:
      case 3:
      case 4: {
        const std::optional<JobRecord> claimed = store_->claim();
        const std::optional<std::string> wanted = model_.claim();
        ASSERT_EQ(claimed ? claimed->id : "nothing", wanted.value_or("nothing"));
        return;
      }
      case 5:
      case 6:
      case 7: {
        const Ending& ending = endings[below(endings.size())];
        ASSERT_EQ(store_->finish(job, attempt, ending), model_.finish(job, attempt, ending));
        return;
      }
      case 8:
        ASSERT_EQ(store_->release(job, attempt), model_.release(job, attempt));
        return;
      case 9: {
        if (below(3) == 0) open();
        ASSERT_EQ(store_->recover(), model_.recover());
        return;
      }
      case 10: {
        now_ms_ += below(40'000);
        std::vector<std::string> woken = store_->wake_due(), wanted = model_.wake_due();
        std::ranges::sort(woken);
        ASSERT_EQ(woken, wanted);
        return;
      }
      case 11:
        ASSERT_EQ(refused_or([&] { return store_->cancel(job); }), model_.cancel(job));
        return;
      case 12:
        ASSERT_EQ(refused_or([&] { return store_->pause(job); }), model_.pause(job));
        return;
      case 13:
        if (below(4) == 0) store_->set_queue_paused(model_.queue_paused = !model_.queue_paused);
        ASSERT_EQ(refused_or([&] { return store_->resume(job); }), model_.resume(job));
        return;
      case 14: {
        if (below(2) == 0) {
          const bool pinned = below(2) == 0;
          store_->pin(job, pinned);
          model_.pin(job, pinned);
        }
        const bool removed = model_.remove(job);
        ASSERT_EQ(store_->remove(job), removed);
        ASSERT_EQ(store_->was_removed(job), removed);
        ASSERT_EQ(store_->last_event(job) == 0, removed);
        return;
      }
      default:
        ASSERT_EQ(refused_or([&] { return store_->retry(job); }), model_.retry(job));
        return;
    }
  }

  void compare() {
    std::map<JobState, std::uint64_t> counts;
    for (const JobState state : job_states) counts[state] = 0;
    const std::vector<JobRecord> records = store_->list({.limit = 1000}).jobs;
    ASSERT_EQ(records.size(), model_.jobs().size());
    for (std::size_t i = 0; i < records.size(); ++i) {
      const ModelJob& wanted = model_.jobs()[i];
      const JobRecord& job = records[i];
      ASSERT_EQ(job.id, wanted.id);
      ASSERT_STREQ(name(job.state), name(wanted.state));
      ASSERT_EQ(job.owner, wanted.owner);
      ASSERT_EQ(job.attempt, wanted.attempt);
      ASSERT_EQ(job.failures, wanted.failures);
      ASSERT_EQ(job.crashes, wanted.crashes);
      ASSERT_EQ(job.finished_at.empty(), !is_final(job.state));
      if (job.state == JobState::queued) {
        ASSERT_EQ(store_->position(job), model_.position(wanted));
      }
      ++counts[wanted.state];
    }
    ASSERT_EQ(store_->counts(), counts);
    ASSERT_EQ(store_->queue_paused(), model_.queue_paused);
  }

  // All events, by number, are those of the jobs.
  void check_numbers() {
    std::uint64_t number = 0;
    std::map<std::string, std::uint64_t> seqs;
    for (const StateEvent& event : store_->events({}, 0, 100'000)) {
      ASSERT_GT(event.number, number);
      ASSERT_EQ(event.seq, ++seqs[event.job]);
      number = event.number;
    }
    ASSERT_LE(number, store_->last_event({}));
    for (const ModelJob& job : model_.jobs()) ASSERT_EQ(seqs[job.id], store_->last_event(job.id));
    ASSERT_EQ(seqs.size(), model_.jobs().size());
  }

  // Gapless, each a move of the table that goes on where the one before ended.
  void check_events() {
    for (const ModelJob& job : model_.jobs()) {
      JobState now = JobState::queued;
      std::uint64_t seq = 0;
      for (const StateEvent& event : store_->events(job.id, 0, 1000)) {
        ASSERT_EQ(event.seq, ++seq);
        const Json data = proto::parse_json(event.data);
        if (seq > 1) {
          ASSERT_EQ(data.at("from"), name(now));
          ASSERT_TRUE(may_move(now, event.to));
        }
        ASSERT_EQ(data.at("to"), name(event.to));
        ASSERT_FALSE(data.at("reason").get<std::string>().empty());
        now = event.to;
      }
      EXPECT_EQ(now, job.state);
      EXPECT_EQ(seq, store_->last_event(job.id));
      EXPECT_EQ(store_->events(job.id, seq - 1, 1000).size(), 1u);
    }
  }

  Random random_;
  TempFolder folder_;
  std::uint64_t now_ms_ = 1'700'000'000'000;
  StoreRules rules_;
  StoreModel model_{rules_, now_ms_};
  std::unique_ptr<JobStore> store_;
};

TEST(StoreProperties, RandomHistoriesEndAsTheModelSays) {
  for (std::uint64_t seed = 0; seed < histories; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    History(seed).play();
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace sculpt::server
