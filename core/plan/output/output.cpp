#include "core/plan/output/output.hpp"

#include <stdexcept>
#include <utility>

#include "core/base/durable_file.hpp"
#include "core/base/error.hpp"
#include "core/trajectory/reader.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_waiting = 1024;
constexpr std::uint64_t bytes_between_starts = 8 << 20;

}  // namespace

Output::Output(const OutputTask& task, std::ios::openmode mode, bool lines, const Watch& watch)
    : path_(task.place.trajectory),
      file_(path_, std::ios::binary | mode),
      lines_(lines ? file_.rdbuf() : nullptr),
      text_(lines_, task.header),
      figures_(task.chain, task.header.grid, task.header.home),
      remove_(task.remove),
      watch_(watch) {
  if (task.place.timeline.empty()) return;
  timeline_file_.open(task.place.timeline, std::ios::binary | std::ios::trunc);
  timeline_.emplace(timeline_file_, task.header, task.voxels);
}

Output::Output(const OutputTask& task, const Watch& watch)
    : Output(task, std::ios::trunc, task.place.form == TrajectoryForm::text, watch) {
  if (task.place.form == TrajectoryForm::binary) binary_.emplace(file_, task.header);
  start_writing(task.threads);
}

Output::Output(const OutputTask& task, const TrajectoryStart& start, const std::function<void(const Keyframe&)>& visit,
               const Watch& watch)
    : Output(task, std::ios::app, false, watch) {
  std::ifstream in(path_, std::ios::binary);
  TrajectoryReader reader(in);
  for (std::uint64_t at = 0; at < start.keyframes; ++at) {
    const Keyframe keyframe = reader.next().value();
    count(keyframe);
    write(keyframe);
    visit(keyframe);
  }
  if (text_.so_far() != start) throw std::logic_error("a trajectory file is not what its checkpoint says");
  marked_ = start;
  started_bytes_ = start.bytes;
  fs::resize_file(path_, start.bytes);
  lines_.rdbuf(file_.rdbuf());
  start_writing(task.threads);
}

void Output::start_writing(int threads) {
  send();
  if (threads > 1)
    beside_.emplace([this](const std::vector<Keyframe>& batch) { write(batch); }, [this] { take_mark(); });
}

void Output::tell_of_growth(std::function<void()> grown) {
  grown_ = std::move(grown);
  grown_();
}

void Output::add(std::vector<Keyframe> batch) {
  if (batch.empty()) return;
  flush();
  for (const Keyframe& keyframe : batch) count(keyframe);
  hand_over(std::move(batch));
  watch_.step(Stage::plan, removed_, remove_);
}

void Output::add(const Keyframe& keyframe) {
  count(keyframe);
  waiting_.push_back(keyframe);
  if (waiting_.size() == max_waiting) flush();
  watch_.step(Stage::plan, removed_, remove_);
}

void Output::count(const Keyframe& keyframe) {
  ++keyframes_;
  removed_ += static_cast<std::uint64_t>(run_length(keyframe));
}

void Output::flush() {
  if (!waiting_.empty()) hand_over(std::exchange(waiting_, {}));
}

void Output::mark() {
  flush();
  if (beside_)
    beside_->add(Mark{});
  else
    take_mark();
}

TrajectoryStart Output::sync() {
  if (beside_) beside_->wait();
  sync_file(path_);
  return marked_;
}

TrajectoryEnd Output::finish() {
  flush();
  if (beside_) beside_->finish();
  const TrajectoryEnd end = text_.finish();
  if (binary_) binary_->finish();
  send();
  return end;
}

void Output::hand_over(std::vector<Keyframe> batch) {
  if (beside_)
    beside_->add(std::move(batch));
  else
    write(batch);
}

void Output::write(const Keyframe& keyframe) {
  text_.add(keyframe);
  if (binary_) binary_->add(keyframe);
  if (timeline_) timeline_->add(keyframe);
  figures_.add(keyframe);
}

void Output::write(const std::vector<Keyframe>& batch) {
  for (const Keyframe& keyframe : batch) write(keyframe);
  send();
}

// What was written so far can be read in the files.
void Output::send() {
  file_.flush();
  if (timeline_) timeline_->flush();
  check();
  if (grown_) grown_();
}

void Output::take_mark() {
  marked_ = text_.so_far();
  if (marked_.bytes - started_bytes_ < bytes_between_starts) return;
  start_sync(path_);
  started_bytes_ = marked_.bytes;
}

void Output::check() const {
  if (!file_ || (lines_.rdbuf() != nullptr && !lines_) || (timeline_ && !timeline_file_))
    throw InputError("file_unwritable", "cannot write '" + path_.string() +
                                            "' or its timeline: check the folder, its rights and the free space");
}

}  // namespace sculpt
