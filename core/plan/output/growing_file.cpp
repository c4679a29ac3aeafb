#include "core/plan/output/growing_file.hpp"

#include <fstream>
#include <utility>
#include <vector>

#include "core/base/watch.hpp"

namespace sculpt {

class GrowingFile::Buffer : public std::streambuf {
 public:
  Buffer(GrowingFile& file, std::filesystem::path path) : file_(file), path_(std::move(path)), bytes_(1 << 16) {}

 protected:
  int_type underflow() override {
    for (;;) {
      std::unique_lock lock(file_.mutex_);
      if (file_.given_up_) throw Cancelled{};
      const std::uint64_t grown = file_.grown_;
      const bool ended = file_.ended_;
      lock.unlock();
      if (const std::streamsize count = grown > 0 ? read() : 0; count > 0) {
        setg(bytes_.data(), bytes_.data(), bytes_.data() + count);
        return traits_type::to_int_type(*gptr());
      }
      if (ended) return traits_type::eof();
      lock.lock();
      file_.changed_.wait(lock, [&] { return file_.given_up_ || file_.ended_ || file_.grown_ != grown; });
    }
  }

 private:
  std::streamsize read() {
    if (!source_.is_open()) source_.open(path_, std::ios::binary);
    source_.clear();
    source_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    return source_.gcount();
  }

  GrowingFile& file_;
  std::filesystem::path path_;
  std::ifstream source_;
  std::vector<char> bytes_;
};

GrowingFile::GrowingFile(std::filesystem::path path)
    : buffer_(std::make_unique<Buffer>(*this, std::move(path))), in_(std::make_unique<std::istream>(buffer_.get())) {
  in_->exceptions(std::ios::badbit);  // what the buffer throws passes through
}

GrowingFile::~GrowingFile() = default;

void GrowingFile::grow() {
  {
    const std::lock_guard lock(mutex_);
    ++grown_;
  }
  changed_.notify_all();
}

void GrowingFile::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
}

bool GrowingFile::ended() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

void GrowingFile::give_up() {
  {
    const std::lock_guard lock(mutex_);
    given_up_ = true;
  }
  changed_.notify_all();
}

}  // namespace sculpt
