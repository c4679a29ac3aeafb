#include "core/trajectory/text/text_source.hpp"

#include <istream>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "core/trajectory/text/plain_line.hpp"
#include "core/trajectory/text/trajectory_line.hpp"

namespace sculpt {
namespace {

// No line of a trajectory comes near: 16 joints take half a KiB. It bounds the memory that hostile input can take.
constexpr std::size_t max_line_bytes = 1 << 20;

std::string line_name(std::uint64_t line) {
  return "trajectory line " + std::to_string(line);
}

[[noreturn]] void refuse(std::uint64_t line, const std::string& what) {
  throw InputError("trajectory_invalid", line_name(line) + ": " + what + "; fetch or plan the trajectory again");
}

class TextSource : public TrajectorySource {
 public:
  explicit TextSource(std::istream& in) : in_(in), buffer_(max_line_bytes) {
    const auto text = read();
    if (!text) refuse(1, "the file is empty");
    header_ = parse_header_line(*text, line_name(1));
    absorb(*text);
  }

  std::optional<Keyframe> next() override {
    if (finished_) return std::nullopt;
    const auto text = read();
    if (!text) refuse(line_, "the end line is missing, the file is cut short");
    auto keyframe = read_plain_line(*text, header_);
    if (!keyframe) {
      TrajectoryLine line = parse_line(*text, header_, line_name(line_));
      if (line.is_end) {
        check_end(line.end);
        finished_ = true;
        return std::nullopt;
      }
      keyframe = std::move(line.keyframe);
    }
    absorb(*text);
    count(*keyframe);
    return keyframe;
  }

 private:
  // The next line without its newline; empty optional at the end of the input.
  std::optional<std::string_view> read() {
    ++line_;
    in_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    const auto taken = static_cast<std::size_t>(in_.gcount());
    if (in_.eof() && taken == 0) return std::nullopt;
    if (in_.bad()) refuse(line_, "the file cannot be read");
    if (in_.fail()) refuse(line_, "longer than " + std::to_string(max_line_bytes) + " bytes");
    return std::string_view(buffer_.data(), in_.eof() ? taken : taken - 1);
  }

  void absorb(std::string_view text) {
    hash_.add(text);
    hash_.add("\n");
  }

  void check_end(const TrajectoryEnd& end) {
    if (end.keyframes != keyframes_)
      refuse(line_, "the end line counts " + std::to_string(end.keyframes) + " keyframes, there are " +
                        std::to_string(keyframes_));
    if (end.removed != removed_)
      refuse(line_, "the end line counts " + std::to_string(end.removed) + " removed voxels, there are " +
                        std::to_string(removed_));
    if (end.sha256 != hash_.hex()) refuse(line_, "the hash does not match the lines before it");
    if (read()) refuse(line_, "there is text after the end line");
  }

  std::istream& in_;
  std::vector<char> buffer_;
  std::uint64_t line_ = 0;
  Sha256 hash_;
};

}  // namespace

std::unique_ptr<TrajectorySource> open_text(std::istream& in) {
  return std::make_unique<TextSource>(in);
}

}  // namespace sculpt
