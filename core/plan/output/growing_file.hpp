// A file that is read while somebody writes it.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <istream>
#include <memory>
#include <mutex>

namespace sculpt {

/// Reading waits until it is told that there is something to read, and again at the end of that, until the file is
/// whole. The stream is for one thread, all else for any.
class GrowingFile {
 public:
  /// `path` is not looked at before `grow`.
  explicit GrowingFile(std::filesystem::path path);
  ~GrowingFile();

  /// Throws Cancelled once reading was given up.
  std::istream& in() { return *in_; }

  /// More was written.
  void grow();
  /// All is written.
  void end();
  bool ended() const;
  /// Whoever reads is to stop.
  void give_up();

 private:
  class Buffer;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t grown_ = 0;  ///< times
  bool ended_ = false, given_up_ = false;
  std::unique_ptr<Buffer> buffer_;
  std::unique_ptr<std::istream> in_;
};

}  // namespace sculpt
