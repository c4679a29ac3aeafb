#include "core/plan/batch_writer.hpp"

namespace sculpt {

BatchWriter::BatchWriter(std::function<void(const std::vector<Keyframe>&)> write)
    : write_(std::move(write)), thread_([this] { run(); }) {}

BatchWriter::~BatchWriter() {
  close();
}

void BatchWriter::add(std::vector<Keyframe> batch) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || waiting_ <= most_waiting; });
  if (failure_) std::rethrow_exception(failure_);
  waiting_ += batch.size();
  batches_.push_back(std::move(batch));
  changed_.notify_all();
}

void BatchWriter::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || (batches_.empty() && !writing_); });
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
  std::vector<Keyframe> batch;
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !batches_.empty(); });
    if (batches_.empty()) return false;
    batch = std::move(batches_.front());
    batches_.pop_front();
    waiting_ -= batch.size();
    writing_ = true;
    changed_.notify_all();
  }
  write_(batch);
  {
    const std::lock_guard lock(mutex_);
    writing_ = false;
  }
  changed_.notify_all();
  return true;
}

}  // namespace sculpt
