#include "core/cell/urdf/xml_tags.hpp"

#include <array>

namespace sculpt {
namespace {

constexpr std::string_view blank = " \t\r\n";
constexpr std::size_t none = std::string_view::npos;

/// Behind the comment or the like that begins at `at`; `at` itself where none does, `none` where one never ends.
std::size_t behind_what_is_no_element(std::string_view xml, std::size_t at) {
  constexpr std::array<std::array<std::string_view, 2>, 4> passed{
      {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}}};
  for (const auto& [open, close] : passed) {
    if (xml.substr(at, open.size()) != open) continue;
    const std::size_t end = xml.find(close, at + open.size());
    return end == none ? none : end + close.size();
  }
  return at;
}

/// Behind the bracket that closes the tag at `at`, which one in quotes does not; `none` where the tag is cut.
std::size_t behind_tag(std::string_view xml, std::size_t at) {
  while ((at = xml.find_first_of(">\"'", at)) != none) {
    if (xml[at] == '>') return at + 1;
    at = xml.find(xml[at], at + 1);
    if (at == none) break;
    ++at;
  }
  return none;
}

}  // namespace

bool XmlTag::closes() const {
  return text.starts_with("</");
}

bool XmlTag::is_empty() const {
  return text.ends_with("/>");
}

std::string_view XmlTag::name() const {
  const std::size_t first = closes() ? 2 : 1;
  return text.substr(first, text.find_first_of(" \t\r\n/>", first) - first);
}

std::optional<std::string_view> XmlTag::attribute(std::string_view called) const {
  for (std::size_t at = text.find(called); at != none; at = text.find(called, at + 1)) {
    if (at == 0 || blank.find(text[at - 1]) == none) continue;
    std::size_t behind = text.find_first_not_of(blank, at + called.size());
    if (behind == none || text[behind] != '=') continue;
    behind = text.find_first_not_of(blank, behind + 1);
    if (behind == none || (text[behind] != '"' && text[behind] != '\'')) continue;
    const std::size_t close = text.find(text[behind], behind + 1);
    if (close != none) return text.substr(behind + 1, close - behind - 1);
  }
  return std::nullopt;
}

std::optional<XmlTag> next_tag(std::string_view xml, std::size_t at) {
  while (at < xml.size() && (at = xml.find('<', at)) != none) {
    const std::size_t behind = behind_what_is_no_element(xml, at);
    if (behind == at) {
      const std::size_t end = behind_tag(xml, at);
      if (end == none) return std::nullopt;
      return XmlTag{at, end, xml.substr(at, end - at)};
    }
    at = behind;
  }
  return std::nullopt;
}

}  // namespace sculpt
