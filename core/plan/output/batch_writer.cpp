#include "core/plan/output/batch_writer.hpp"

namespace sculpt {

BatchWriter::BatchWriter(std::function<void(const std::vector<Keyframe>&)> write, std::function<void()> mark)
    : write_(std::move(write)), mark_(std::move(mark)), thread_([this] { run(); }) {}

BatchWriter::~BatchWriter() {
  close();
}

void BatchWriter::add(std::vector<Keyframe> batch) {
  const std::size_t keyframes = batch.size();
  add(Part(std::move(batch)), keyframes);
}

void BatchWriter::add(Mark mark) {
  add(Part(mark), 0);
}

void BatchWriter::add(Part part, std::size_t keyframes) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || waiting_ <= max_waiting; });
  if (failure_) std::rethrow_exception(failure_);
  waiting_ += keyframes;
  parts_.push_back(std::move(part));
  changed_.notify_all();
}

void BatchWriter::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || (parts_.empty() && !writing_); });
  if (failure_) std::rethrow_exception(failure_);
}

void BatchWriter::finish() {
  close();
  if (failure_) std::rethrow_exception(failure_);
}

void BatchWriter::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void BatchWriter::run() {
  try {
    while (write_next()) {
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    changed_.notify_all();
  }
}

bool BatchWriter::write_next() {
  Part part;
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !parts_.empty(); });
    if (parts_.empty()) return false;
    part = std::move(parts_.front());
    parts_.pop_front();
    if (const auto* batch = std::get_if<std::vector<Keyframe>>(&part)) waiting_ -= batch->size();
    writing_ = true;
    changed_.notify_all();
  }
  if (const auto* batch = std::get_if<std::vector<Keyframe>>(&part))
    write_(*batch);
  else
    mark_();
  {
    const std::lock_guard lock(mutex_);
    writing_ = false;
  }
  changed_.notify_all();
  return true;
}

}  // namespace sculpt
