#include "core/cell/urdf_guard.hpp"

#include "core/base/error.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_urdf_bytes = 2u << 20;

[[noreturn]] void refuse(const std::string& sentence) {
  throw InputError("urdf_invalid", sentence);
}

/// tinyxml parses recursively, so nesting without end would overflow the stack.
void refuse_deep_nesting(const std::string& xml) {
  constexpr int deepest = 100;
  int depth = 0;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
    if (xml.compare(at, 4, "<!--") == 0) {
      at = xml.find("-->", at);
      if (at == std::string::npos) return;
      continue;
    }
    const char kind = at + 1 < xml.size() ? xml[at + 1] : '\0';
    char quote = 0;
    std::size_t end = at + 1;
    for (; end < xml.size() && (quote || xml[end] != '>'); ++end) {
      if (quote ? xml[end] == quote : (xml[end] == '"' || xml[end] == '\'')) quote = quote ? 0 : xml[end];
    }
    if (kind == '/') {
      --depth;
    } else if (kind != '?' && kind != '!' && end > 0 && xml[end - 1] != '/') {
      ++depth;
    }
    if (depth > deepest) refuse("the URDF nests elements more than 100 deep: it is no URDF, or damaged");
    at = end;
  }
}

/// urdfdom skips what it does not know, so that of a xacro source parts would be missing. (A URDF that xacro wrote
/// names its namespace still, and may have its source in comments.)
void refuse_xacro(const std::string& xml) {
  std::size_t at = 0;
  while ((at = xml.find('<', at)) != std::string::npos) {
    if (xml.compare(at, 7, "<xacro:") == 0)
      refuse(
          "the file is a xacro source, not a URDF: write it out with `xacro robot.urdf.xacro > robot.urdf`, and name "
          "that file");
    if (xml.compare(at, 4, "<!--") == 0) at = xml.find("-->", at);
    if (at != std::string::npos) ++at;
  }
}

}  // namespace

void check_urdf(const std::string& xml) {
  if (xml.size() > max_urdf_bytes)
    refuse("the URDF has " + std::to_string(xml.size()) + " bytes, the limit is " + std::to_string(max_urdf_bytes));
  refuse_deep_nesting(xml);
  refuse_xacro(xml);
}

}  // namespace sculpt
