#include "core/trajectory/export.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <istream>
#include <ostream>
#include <string>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "core/trajectory/trajectory_line.hpp"

namespace sculpt {
namespace {

constexpr std::string_view magic = "SCULPTRJ";
constexpr std::uint32_t binary_version = 1;
constexpr std::uint32_t longest_header = 1 << 20;
enum class Record : std::uint8_t { move, cut, end };

// Bytes out, hashed on the way; whole numbers and doubles little-endian on every machine.
class BinaryOut {
 public:
  explicit BinaryOut(std::ostream& out) : out_(out) {}

  void bytes(std::string_view text) {
    hash_.add(text);
    out_.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  template <typename Word>
  void word(Word value) {
    std::array<char, sizeof(Word)> raw;
    for (std::size_t at = 0; at < raw.size(); ++at) raw[at] = static_cast<char>(value >> (8 * at) & 0xff);
    bytes({raw.data(), raw.size()});
  }
  void hash() { out_ << hash_.hex(); }

 private:
  std::ostream& out_;
  Sha256 hash_;
};

class BinaryIn {
 public:
  explicit BinaryIn(std::istream& in) : in_(in) {}

  std::string where() const { return "binary trajectory byte " + std::to_string(offset_); }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError("trajectory_invalid", where() + ": " + what + "; fetch or plan the trajectory again");
  }
  std::string bytes(std::size_t size) {
    std::string text = raw(size);
    hash_.add(text);
    return text;
  }
  template <typename Word>
  Word word() {
    Word value = 0;
    const std::string text = bytes(sizeof(Word));
    for (std::size_t at = 0; at < text.size(); ++at)
      value |= static_cast<Word>(static_cast<Word>(static_cast<unsigned char>(text[at])) << (8 * at));
    return value;
  }
  void check_hash() {
    if (raw(64) != hash_.hex()) refuse("the hash does not match the bytes before it");
    if (in_.peek() != std::istream::traits_type::eof()) refuse("there is more after the hash");
  }

 private:
  std::string raw(std::size_t size) {
    std::string text(size, '\0');
    in_.read(text.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::size_t>(in_.gcount()) != size) refuse("the file is cut short");
    offset_ += size;
    return text;
  }

  std::istream& in_;
  std::uint64_t offset_ = 0;
  Sha256 hash_;
};

void write_voxel(BinaryOut& out, Voxel voxel) {
  for (int index : {voxel.i, voxel.j, voxel.k}) out.word(static_cast<std::uint32_t>(index));
}

Voxel read_voxel(BinaryIn& in) {
  std::array<int, 3> at{};
  for (int& index : at) index = static_cast<int>(in.word<std::uint32_t>());
  return {at[0], at[1], at[2]};
}

Keyframe read_keyframe(BinaryIn& in, bool cut, const TrajectoryHeader& header) {
  Keyframe keyframe;
  keyframe.cut = cut;
  if (cut) {
    keyframe.first = read_voxel(in);
    keyframe.last = read_voxel(in);
    check_run(keyframe, header.grid, in.where());
  }
  keyframe.q.resize(static_cast<Eigen::Index>(header.joints.size()));
  for (double& value : keyframe.q) {
    value = std::bit_cast<double>(in.word<std::uint64_t>());
    if (!std::isfinite(value)) in.refuse("a joint value is not finite");
  }
  return keyframe;
}

// A field as RFC 4180 wants it: joint names may hold commas or quotes.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_row(const Keyframe& keyframe) {
  std::string row = keyframe.cut ? "cut" : "move";
  for (double value : keyframe.q) {
    row += ',';
    append_number(row, value);
  }
  for (Voxel voxel : {keyframe.first, keyframe.last})
    for (int index : {voxel.i, voxel.j, voxel.k}) {
      row += ',';
      if (keyframe.cut) row += std::to_string(index);
    }
  return row + "\n";
}

}  // namespace

void export_csv(std::istream& ndjson, std::ostream& csv) {
  TrajectoryReader reader(ndjson);
  csv << "# sculpt trajectory: each row is a linear joint motion from the row before it, the first one starts at home\n"
         "# joints in rad or m; a cut removes the straight run of voxels first..last\n"
         "# "
      << header_line(reader.header()) << "\ntype";
  for (const std::string& joint : reader.header().joints) csv << ',' << csv_field(joint);
  csv << ",first_i,first_j,first_k,last_i,last_j,last_k\n";
  while (const auto keyframe = reader.next()) csv << csv_row(*keyframe);
}

void export_binary(std::istream& ndjson, std::ostream& sct) {
  TrajectoryReader reader(ndjson);
  const std::string header = header_line(reader.header());
  BinaryOut out(sct);
  out.bytes(magic);
  out.word(binary_version);
  out.word(static_cast<std::uint32_t>(header.size()));
  out.bytes(header);
  std::uint64_t keyframes = 0;
  while (const auto keyframe = reader.next()) {
    out.word(static_cast<std::uint8_t>(keyframe->cut ? Record::cut : Record::move));
    if (keyframe->cut) {
      write_voxel(out, keyframe->first);
      write_voxel(out, keyframe->last);
    }
    for (double value : keyframe->q) out.word(std::bit_cast<std::uint64_t>(value));
    ++keyframes;
  }
  out.word(static_cast<std::uint8_t>(Record::end));
  out.word(keyframes);
  out.hash();
}

void import_binary(std::istream& sct, std::ostream& ndjson) {
  BinaryIn in(sct);
  if (in.bytes(magic.size()) != magic) in.refuse("not an .sct file");
  if (const auto version = in.word<std::uint32_t>(); version != binary_version)
    in.refuse("version " + std::to_string(version) + " is not known, only " + std::to_string(binary_version));
  const auto header_size = in.word<std::uint32_t>();
  if (header_size > longest_header) in.refuse("the header is longer than " + std::to_string(longest_header) + " bytes");
  const TrajectoryHeader header = parse_header_line(in.bytes(header_size), in.where());
  TrajectoryWriter writer(ndjson, header);
  for (std::uint64_t keyframes = 0;; ++keyframes) {
    const auto record = in.word<std::uint8_t>();
    if (record > static_cast<std::uint8_t>(Record::end))
      in.refuse("record type " + std::to_string(record) + " is not known");
    if (record == static_cast<std::uint8_t>(Record::end)) {
      if (in.word<std::uint64_t>() != keyframes) in.refuse("the count of keyframes is wrong");
      break;
    }
    writer.add(read_keyframe(in, record == static_cast<std::uint8_t>(Record::cut), header));
  }
  in.check_hash();
  writer.finish();
}

}  // namespace sculpt
