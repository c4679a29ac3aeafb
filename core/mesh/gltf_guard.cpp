#include "core/mesh/gltf_guard.hpp"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <unordered_set>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

constexpr int depth_limit = 64;     // of JSON; plain glTF stays below 10
constexpr int parent_limit = 2000;  // nodes with children: the longest chain of nodes there can be

[[noreturn]] void refuse_gltf(const std::string& why) {
  throw InputError("mesh_unreadable", "the glTF file " + why);
}

class Guard {
 public:
  explicit Guard(std::string_view json) : json_(json) {}

  void check() {
    int depth = 0;
    while (at_ < json_.size()) {
      const char c = json_[at_];
      if (c == '"') {
        check_string();
        continue;
      }
      if (c == '{' || c == '[') ++depth;
      if (c == '}' || c == ']') --depth;
      if (depth > depth_limit) refuse_gltf("nests its JSON deeper than 64 levels: export the mesh again");
      ++at_;
    }
  }

 private:
  void check_string() {
    const std::size_t first = ++at_;
    bool escaped = false;
    for (; at_ < json_.size() && json_[at_] != '"'; ++at_) {
      if (json_[at_] != '\\') continue;
      escaped = true;
      ++at_;
    }
    if (at_ >= json_.size()) return;
    const std::string_view word = json_.substr(first, at_ - first);
    ++at_;
    skip_space();
    if (at_ >= json_.size() || json_[at_] != ':') return;
    if (escaped) refuse_gltf("has an escaped name in its JSON: export the mesh again");
    ++at_;
    if (word == "children") {
      if (++parents_ > parent_limit)
        refuse_gltf("has more than 2000 nodes with children: join its parts and export again");
      check_references(children_);
    } else if (word == "nodes") {
      std::unordered_set<std::uint64_t> roots;
      check_references(roots);
    }
  }

  /// The numbers of a list of nodes, none of which may be in `seen` yet.
  void check_references(std::unordered_set<std::uint64_t>& seen) {
    skip_space();
    if (at_ >= json_.size() || json_[at_] != '[') return;
    std::size_t at = at_ + 1;
    while (at < json_.size() && json_[at] != ']' && json_[at] != '{') {
      std::uint64_t node = 0;
      const auto [end, error] = std::from_chars(json_.data() + at, json_.data() + json_.size(), node);
      if (error == std::errc{} && !seen.insert(node).second)
        refuse_gltf("shows node " + std::to_string(node) +
                    " in more than one place: apply the instances and export again");
      at = error == std::errc{} ? static_cast<std::size_t>(end - json_.data()) : at + 1;
    }
  }

  void skip_space() {
    while (at_ < json_.size() && std::string_view(" \t\r\n").find(json_[at_]) != std::string_view::npos) ++at_;
  }

  std::string_view json_;
  std::size_t at_ = 0;
  int parents_ = 0;
  std::unordered_set<std::uint64_t> children_;
};

}  // namespace

void check_gltf(std::string_view bytes, const std::string& extension) {
  constexpr std::size_t header = 20;  // of a .glb: magic, version, length, then length and kind of the JSON chunk
  if (extension == "gltf") Guard(bytes).check();
  if (extension != "glb" || bytes.size() < header) return;
  std::uint32_t json_bytes = 0;
  std::memcpy(&json_bytes, bytes.data() + 12, sizeof json_bytes);
  Guard(bytes.substr(header, json_bytes)).check();
}

}  // namespace sculpt
