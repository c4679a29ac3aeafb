#include "core/law/law_file.hpp"

#include <zlib.h>

#include <bit>
#include <istream>
#include <ostream>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "core/law/coarse.hpp"

namespace sculpt {
namespace {

constexpr std::string_view magic = "SCULPLAW";
constexpr std::uint32_t version = 1;
constexpr std::size_t corner_bytes = 16, corners_a_piece = 4096, hash_bytes = 64;
constexpr std::uint64_t max_keyframes = std::uint64_t{1} << 32;

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("law_invalid", "the time law's file " + what + ": make it again with sculpt time -o");
}

template <typename Word>
void append(std::string& out, Word value) {
  for (std::size_t at = 0; at < sizeof(Word); ++at) out += static_cast<char>(value >> (8 * at) & 0xff);
}
void append_double(std::string& out, double value) {
  append(out, std::bit_cast<std::uint64_t>(value));
}
void append_float(std::string& out, float value) {
  append(out, std::bit_cast<std::uint32_t>(value));
}

// Bytes in, all of them hashed.
class Source {
 public:
  explicit Source(std::istream& in) : in_(in) {}

  std::string_view take(std::size_t size) {
    bytes_.resize(size);
    if (!in_.read(bytes_.data(), static_cast<std::streamsize>(size))) refuse("is cut short");
    hash_.add(bytes_);
    return bytes_;
  }
  template <typename Word>
  Word word() {
    return word_in<Word>(take(sizeof(Word)), 0);
  }
  double number() { return std::bit_cast<double>(word<std::uint64_t>()); }

  template <typename Word>
  static Word word_in(std::string_view bytes, std::size_t offset) {
    Word value = 0;
    for (std::size_t at = 0; at < sizeof(Word); ++at)
      value |= static_cast<Word>(static_cast<Word>(static_cast<unsigned char>(bytes[offset + at])) << (8 * at));
    return value;
  }

  void check_end() {
    const std::string expected = hash_.hex();
    std::string found(hash_bytes, '\0');
    if (!in_.read(found.data(), hash_bytes)) refuse("is cut short");
    if (found != expected) refuse("is damaged, its hash does not match");
    if (in_.peek() != std::istream::traits_type::eof()) refuse("has more bytes than it should");
  }

 private:
  std::istream& in_;
  std::string bytes_;
  Sha256 hash_;
};

LawCorner corner_in(std::string_view bytes, std::size_t offset) {
  const auto number = [&](std::size_t at) {
    return std::bit_cast<float>(Source::word_in<std::uint32_t>(bytes, offset + at));
  };
  const auto coarse = [&](std::size_t at) {
    return static_cast<float>(from_coarse(Source::word_in<std::uint16_t>(bytes, offset + at)));
  };
  const LawCorner corner{coarse(0), coarse(2), number(4), number(8), number(12)};
  for (const float x : {corner.x_in, corner.x_mid, corner.x_out})
    if (!(x >= 0) || !std::isfinite(x)) refuse("holds a speed that is none");
  return corner;
}

}  // namespace

void PlanMark::add(const Configuration& q) {
  std::string bytes;
  for (const double value : q) append_double(bytes, value);
  crc = static_cast<std::uint32_t>(crc32_z(keyframes == 0 ? crc32_z(0, nullptr, 0) : crc,
                                           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  ++keyframes;
}

void write_law(std::ostream& out, const TimeLaw& law, const PlanMark& plan) {
  std::string bytes(magic);
  Sha256 hash;
  const auto send = [&] {
    hash.add(bytes);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.clear();
  };
  append(bytes, version);
  append(bytes, static_cast<std::uint32_t>(law.acceleration.size()));
  append(bytes, plan.keyframes);
  append(bytes, plan.crc);
  for (const double value : {law.window_s, law.feed_m_s, law.rapid_m_s}) append_double(bytes, value);
  for (const double value : law.acceleration) append_double(bytes, value);
  for (const LawCorner& corner : law.corners) {
    append(bytes, to_coarse(static_cast<double>(corner.half)));
    append(bytes, to_coarse(static_cast<double>(corner.cruise)));
    for (const float x : {corner.x_in, corner.x_mid, corner.x_out}) append_float(bytes, x);
    if (bytes.size() >= corner_bytes * corners_a_piece) send();
  }
  send();
  out << hash.hex();
}

LawFile read_law(std::istream& in) {
  Source source(in);
  LawFile file;
  if (source.take(magic.size()) != magic) refuse("is none");
  if (const auto found = source.word<std::uint32_t>(); found != version)
    refuse("is of version " + std::to_string(found) + ", only " + std::to_string(version) + " is known");
  const auto coordinates = source.word<std::uint32_t>();
  if (coordinates < 1 || coordinates > max_joints) refuse("names " + std::to_string(coordinates) + " joints");
  file.plan.keyframes = source.word<std::uint64_t>();
  if (file.plan.keyframes >= max_keyframes) refuse("counts more keyframes than a plan can have");
  file.plan.crc = source.word<std::uint32_t>();
  for (double* value : {&file.law.window_s, &file.law.feed_m_s, &file.law.rapid_m_s}) *value = source.number();
  for (std::uint32_t joint = 0; joint < coordinates; ++joint) file.law.acceleration.push_back(source.number());
  for (const double value : file.law.acceleration)
    if (!(value > 0) || !std::isfinite(value)) refuse("holds an acceleration that is none");
  if (!(file.law.window_s >= 0) || !std::isfinite(file.law.window_s)) refuse("holds a window that is none");
  for (std::uint64_t left = file.plan.keyframes; left > 0;) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, corners_a_piece));
    const std::string_view bytes = source.take(count * corner_bytes);
    for (std::size_t at = 0; at < count; ++at) file.law.corners.push_back(corner_in(bytes, at * corner_bytes));
    left -= count;
  }
  source.check_end();
  return file;
}

}  // namespace sculpt
