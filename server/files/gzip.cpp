#include "server/files/gzip.hpp"

#include <zlib.h>

#include <istream>
#include <new>
#include <ostream>
#include <stdexcept>
#include <vector>

namespace sculpt::server {
namespace {

constexpr int gzip_window = 15 + 16, memory_level = 8, level = 6;
constexpr std::size_t packed_piece_bytes = 1 << 16;

Bytef* bytes_of(char* text) {
  return reinterpret_cast<Bytef*>(text);
}

}  // namespace

void write_gzip(std::istream& in, std::ostream& out) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, gzip_window, memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::vector<char> plain(packed_piece_bytes), packed(packed_piece_bytes);
  for (int status = Z_OK; status != Z_STREAM_END;) {
    in.read(plain.data(), static_cast<std::streamsize>(plain.size()));
    stream.next_in = bytes_of(plain.data());
    stream.avail_in = static_cast<uInt>(in.gcount());
    do {
      stream.next_out = bytes_of(packed.data());
      stream.avail_out = static_cast<uInt>(packed.size());
      status = deflate(&stream, in ? Z_NO_FLUSH : Z_FINISH);
      out.write(packed.data(), static_cast<std::streamsize>(packed.size() - stream.avail_out));
    } while (stream.avail_out == 0);
  }
  deflateEnd(&stream);
}

std::string read_gzip(std::string_view bytes) {
  z_stream stream{};
  if (inflateInit2(&stream, gzip_window) != Z_OK) throw std::bad_alloc();
  std::string packed(bytes), plain;
  std::vector<char> piece(packed_piece_bytes);
  stream.next_in = bytes_of(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = bytes_of(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    status = inflate(&stream, Z_NO_FLUSH);
    plain.append(piece.data(), piece.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("these bytes are not gzip, or cut short");
  return plain;
}

}  // namespace sculpt::server
