#include "server/fleet/fleet_store.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>

#include "server/base/job_id.hpp"
#include "server/fleet/fleet_files.hpp"
#include "server/fleet/fleet_follower.hpp"
#include "server/fleet/fleet_leases.hpp"
#include "server/fleet/fleet_queue.hpp"
#include "server/fleet/fleet_reader.hpp"
#include "server/fleet/fleet_schema.hpp"
#include "server/store/job_commands.hpp"
#include "server/store/run_ending.hpp"

namespace sculpt::server {
namespace {

using enum JobState;

constexpr std::chrono::seconds store_patience{10};
constexpr const char* last_id =
    "SELECT greatest((SELECT max(id) FROM sculptd.job), (SELECT max(id) FROM sculptd.removed))";

class PostgresFleetStore : public FleetStore {
 public:
  PostgresFleetStore(FleetRules fleet, StoreRules rules)
      : rules_(std::move(rules)),
        fleet_(std::move(fleet)),
        database_(fleet_.source, store_patience),
        reader_((update_fleet_schema(fleet_.source), fleet_.source)),
        leases_(fleet_.source, fleet_.member, fleet_.lease),
        follower_(fleet_.source, feed_) {
    epoch_ = reader_.epoch();
    if (fleet_.keeps_files) files_.emplace(fleet_.source);
    feed_.start(database_);
    last_rank_ms_ =
        database_.ask({"SELECT max(rank + $1 * priority) FROM sculptd.job", {sql_value(ageing())}}).number(0, 0);
  }
  ~PostgresFleetStore() override { PostgresFleetStore::leave(); }

  void join(const std::string& address, FleetHooks hooks) override {
    leases_.start(hooks, address);
    follower_.start(std::move(hooks.changed));
  }
  void leave() override {
    follower_.stop();
    leases_.stop();
  }

  std::string epoch() override { return epoch_; }

  Submitted submit(const NewJob& wanted) override {
    Change change(*this);
    std::vector<Question> questions = feed_.questions();
    questions.push_back(FleetRows::selection("WHERE key=$1", {sql_value(wanted.key)}));
    questions.push_back({last_id});
    // From here on submits of all daemons are one after the other.
    const std::vector<Answered> answers = change.transaction.lock_events(questions);
    if (answers[2].rows() > 0) return repeat_submit(read_fleet_row(answers[2], 0).job, wanted);
    const std::string last = answers[3].text(0, 0);
    refuse_unserved(wanted.schedule.queue, served_queues(wanted.schedule.queue));
    if (feed_.take(answers[0], answers[1])) feed_.read(database_);
    refuse_too_many(feed_.tally(), rules_, wanted.owner);
    const std::uint64_t now_ms = change.jobs.now_ms();
    last_rank_ms_ = std::max(last_rank_ms_, static_cast<std::int64_t>(now_ms));
    const JobRow row = change.jobs.insert(make_job(wanted, IdMaker(last).next(now_ms), now_ms, last_rank_ms_, rules_));
    change.commit();
    return {row.job, false};
  }

  std::optional<JobRecord> claim() override {
    if (unknown_claim_) give_back_unheld();
    const auto since = FleetLeases::Clock::now();
    Change change(*this);
    std::optional<JobRow> next = next_job(change.part, {leases_.at_work(), feed_.tally()}, rules_, newer_schema_);
    if (!next) return std::nullopt;
    JobRow& row = *next;
    start_run(change.jobs, rules_, row);
    try {
      change.commit();
    } catch (const CommitUnknown&) {
      unknown_claim_ = true;
      throw;
    }
    leases_.hold(row.job, since);
    row.job.folder = attempt_folder(row.job);
    return row.job;
  }

  bool finish(const std::string& id, int attempt, const Ending& ending) override {
    return end(id, attempt, [&](JobTable& jobs, JobRow& row) { end_run(jobs, rules_, row, ending); });
  }

  bool release(const std::string& id, int attempt) override {
    return end(id, attempt, [](JobTable& jobs, JobRow& row) { stop_run(jobs, row); });
  }

  int recover() override {
    Change change(*this);
    std::vector<JobRow> left = own_jobs(change);
    for (JobRow& row : left) abandon_run(change.jobs, row);
    change.commit();
    leases_.let_go_all();
    return static_cast<int>(left.size());
  }

  std::vector<std::string> wake_due() override {
    Change change(*this);
    feed_.read(database_);
    const SqlValue at_work = feed_.at_work();
    if (!is_anything_due(database_, rules_, at_work)) return {};
    std::vector<std::string> changed = change_due(change.part, at_work);
    change.commit();
    return changed;
  }

  JobState cancel(const std::string& id) override {
    return change_job(id, [](Change& change, JobRow& row) { cancel_job(change.jobs, row); });
  }
  JobState pause(const std::string& id) override {
    return change_job(id, [](Change& change, JobRow& row) { pause_job(change.jobs, row); });
  }
  JobState resume(const std::string& id) override {
    return change_job(id, [](Change& change, JobRow& row) { resume_job(change.jobs, row); });
  }
  JobState retry(const std::string& id) override {
    return change_job(id, [this](Change& change, JobRow& row) { retry_job(change.jobs, rules_, row); });
  }

  void set_queue_paused(bool wanted) override {
    write({"INSERT INTO sculptd.meta VALUES('queue_paused', $1) ON CONFLICT(name) DO UPDATE SET value=$1",
           {sql_value(std::string(wanted ? "1" : "0"))}});
  }

  void note_damage(const std::string& id, const std::string& sentence) override {
    write(
        {"UPDATE sculptd.job SET error_code=$1, error_sentence=$2 WHERE id=$3 AND state IN ('succeeded', 'failed') "
         "AND EXISTS(SELECT 1 FROM sculptd.artifact WHERE artifact.job = job.number)",
         {sql_value(std::string(damage_code)), sql_value(sentence), sql_value(id)}});
  }

  void pin(const std::string& id, bool pinned) override {
    if (write({"UPDATE sculptd.job SET pinned=$1 WHERE id=$2", {sql_flag(pinned), sql_value(id)}}) != 1)
      refuse_unknown(id);
  }

  bool remove(const std::string& id) override {
    Change change(*this);
    const std::optional<JobRow> row = change.rows.find(id);
    if (!row || !is_final(row->job.state) || row->job.pinned) return false;
    change.jobs.erase(*row);
    change.commit();
    return true;
  }

  std::map<JobState, std::uint64_t> counts() override { return feed_.tally().counts(); }
  std::uint64_t position(const JobRecord& job) override {
    return feed_.tally().position(job.schedule.queue, job.rank, job.id);
  }
  const Histogram& commit_times() override { return commit_times_; }

  std::string settle(const std::string& name, const std::string& value) override {
    write(
        {"INSERT INTO sculptd.meta VALUES($1, $2) ON CONFLICT(name) DO NOTHING", {sql_value(name), sql_value(value)}});
    const std::lock_guard lock(mutex_);
    return database_.ask_again({{"SELECT value FROM sculptd.meta WHERE name=$1", {sql_value(name)}}})
        .front()
        .text(0, 0);
  }
  std::uint64_t now_ms() const override { return leases_.now_ms(); }
  SharedFiles* files() override { return files_ ? &*files_ : nullptr; }
  std::vector<FleetDaemon> daemons() override { return reader_.daemons(); }
  std::optional<Progress> progress(const std::string& job) override { return follower_.progress(job); }
  bool sweeps() const override { return leases_.sweeps(); }
  std::uint64_t leases_lost() const override { return leases_.lost(); }
  std::uint64_t late_ends() const override { return late_ends_; }
  DatabaseFigures figures() const override { return leases_.figures(); }
  std::string why_idle() const override { return schema_too_new(newer_schema_); }

 protected:
  JobReader& reader() override { return reader_; }

 private:
  /// One change of the store: its lock, and a transaction that is undone unless committed.
  struct Change {
    explicit Change(PostgresFleetStore& owner)
        : store(owner), lock(owner.mutex_), part(owner.database_, owner.lease_, owner.rules_) {}

    void commit() {
      if (part.jobs.take_moves().empty()) return;
      part.commit(store.commit_times_, store.feed_);
    }

    PostgresFleetStore& store;
    std::unique_lock<std::mutex> lock;
    FleetChange part;
    PostgresChange& transaction = part.transaction;
    FleetRows& rows = part.rows;
    JobTable& jobs = part.jobs;
  };

  std::int64_t ageing() const { return static_cast<std::int64_t>(rules_.ageing_ms); }

  // Others' only where they matter.
  std::vector<std::string> served_queues(const std::string& wanted) {
    std::vector<std::string> served = rules_.queues;
    if (std::ranges::find(served, wanted) != served.end()) return served;
    for (const FleetDaemon& daemon : reader_.daemons())
      for (const std::string& queue : daemon.queues)
        if (std::ranges::find(served, queue) == served.end()) served.push_back(queue);
    return served;
  }

  std::int64_t write(const Question& question) {
    const std::lock_guard lock(mutex_);
    return database_.ask(question).changed();
  }

  // That the database says this daemon runs, each locked.
  std::vector<JobRow> own_jobs(Change& change) {
    return change.rows.select(
        "JOIN sculptd.lease ON lease.job = job.number WHERE daemon=$1 ORDER BY number FOR UPDATE OF job, lease",
        {sql_value(fleet_.member.id)});
  }

  // Nobody runs a job whose claim was committed and never answered; others would wait for the end of its lease. One
  // whose commit is not done yet is not seen here, and does wait for it.
  void give_back_unheld() {
    Change change(*this);
    for (JobRow& row : own_jobs(change))
      if (!leases_.holds(row.job.id)) stop_run(change.jobs, row);
    change.commit();
    unknown_claim_ = false;
  }

  // The run of this attempt has ended. A commit whose answer was lost is looked for when it is tried again.
  template <typename Act>
  bool end(const std::string& id, int attempt, Act act) {
    Change change(*this);
    std::optional<JobRow> row = change.rows.find(id);
    const bool owned = row && row->job.attempt == attempt && is_active(row->job.state);
    const bool done = row && !owned && row->job.attempt == attempt && unknown_ends_.contains({id, attempt});
    if (owned) {
      act(change.jobs, *row);
      try {
        change.commit();
      } catch (const CommitUnknown&) {
        unknown_ends_.insert({id, attempt});
        throw;
      }
    }
    unknown_ends_.erase({id, attempt});
    leases_.let_go(id, attempt);
    if (!owned && !done) ++late_ends_;
    return owned || done;
  }

  template <typename Act>
  JobState change_job(const std::string& id, Act act) {
    Change change(*this);
    std::optional<JobRow> row = change.rows.find(id);
    if (!row) refuse_unknown(id);
    act(change, *row);
    change.commit();
    return row->job.state;
  }

  std::mutex mutex_;  // of the connection that writes; the others have their own
  StoreRules rules_;
  FleetRules fleet_;
  FleetRows::Lease lease_{fleet_.member.id, fleet_.lease};
  Postgres database_;
  FleetReader reader_;
  std::optional<FleetFiles> files_;
  FleetFeed feed_;
  FleetLeases leases_;
  FleetFollower follower_;
  Histogram commit_times_;
  std::string epoch_;
  std::int64_t last_rank_ms_ = 0;
  std::set<std::pair<std::string, int>> unknown_ends_;
  std::atomic<bool> unknown_claim_ = false;
  std::atomic<std::uint64_t> late_ends_ = 0;
  std::atomic<std::int64_t> newer_schema_ = 0;
};

}  // namespace

std::unique_ptr<FleetStore> open_fleet_store(FleetRules fleet, StoreRules rules) {
  return std::make_unique<PostgresFleetStore>(std::move(fleet), std::move(rules));
}

}  // namespace sculpt::server
