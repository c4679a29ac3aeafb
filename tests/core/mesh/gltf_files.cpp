#include "tests/core/mesh/gltf_files.hpp"

#include <cmath>
#include <cstdint>

namespace sculpt::gltf_files {
namespace {

void put(std::string& bytes, const auto& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string buffer(float first) {
  std::string bytes;
  put(bytes, first);
  for (float f : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) put(bytes, f);
  for (std::uint16_t index : {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}) put(bytes, index);
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {  // 72 bytes: no rest
    unsigned three = 0;
    for (std::size_t b = 0; b < 3; ++b) three = three << 8 | static_cast<unsigned char>(bytes[at + b]);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[three >> shift & 63];
  }
  return text;
}

std::string json(const std::string& nodes, const std::string& uri) {
  const std::string where = uri.empty() ? "" : R"(,"uri":")" + uri + "\"";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":72)" +
         where +
         R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)" +
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},)" +
         R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})";
}

std::string glb(std::string text, const std::string& data) {
  while (text.size() % 4 != 0) text += ' ';
  std::string bytes = "glTF";
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + data.size()));
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  put(bytes, static_cast<std::uint32_t>(data.size()));
  bytes += std::string("BIN\0", 4) + data;
  return bytes;
}

}  // namespace

std::string embedded(const std::string& nodes, const std::string& uri) {
  return json(nodes, uri.empty() ? "data:application/octet-stream;base64," + base64(buffer(0)) : uri);
}

std::string binary(const std::string& nodes) {
  return glb(json(nodes, ""), buffer(0));
}

std::string binary_with_nan() {
  return glb(json(R"([{"mesh":0}])", ""), buffer(std::nanf("")));
}

}  // namespace sculpt::gltf_files
