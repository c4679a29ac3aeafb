#include "core/doctor/make/urdf_text.hpp"

#include <set>

#include "core/base/error.hpp"
#include "core/cell/urdf/xml_tags.hpp"

namespace sculpt {
namespace {

std::string value(const XmlTag& tag, std::string_view attribute) {
  return std::string(tag.attribute(attribute).value_or(""));
}

/// What stands in an element right below the robot: links that a joint joins.
void note_joined(const XmlTag& tag, UrdfElement& element) {
  if (tag.name() == "parent") element.parent = value(tag, "link");
  if (tag.name() == "child") element.child = value(tag, "link");
}

}  // namespace

std::vector<UrdfElement> urdf_elements(const std::string& xml) {
  std::vector<UrdfElement> found;
  int depth = 0;
  for (auto tag = next_tag(xml, 0); tag; tag = next_tag(xml, tag->end)) {
    if (tag->closes()) {
      if (--depth == 1 && !found.empty()) found.back().end = tag->end;
      continue;
    }
    if (depth == 1) found.push_back({std::string(tag->name()), value(*tag, "name"), {}, {}, tag->begin, tag->end});
    if (depth == 2) note_joined(*tag, found.back());
    if (!tag->is_empty()) ++depth;
  }
  std::erase_if(found, [](const UrdfElement& element) { return element.tag != "link" && element.tag != "joint"; });
  return found;
}

std::string without_branch(const std::string& xml, const std::string& link) {
  const std::vector<UrdfElement> all = urdf_elements(xml);
  std::set<std::string> gone{link};
  for (std::size_t before = 0; before != gone.size();) {
    before = gone.size();
    for (const UrdfElement& element : all)
      if (element.tag == "joint" && gone.count(element.parent) > 0) gone.insert(element.child);
  }
  std::string left = xml;
  bool found = false;
  for (auto element = all.rbegin(); element != all.rend(); ++element) {
    const bool is_link = element->tag == "link";
    found = found || (is_link && element->name == link);
    if (is_link ? gone.count(element->name) > 0 : gone.count(element->child) > 0)
      left.erase(element->begin, element->end - element->begin);
  }
  if (!found) throw InputError("urdf_invalid", "the URDF has no link '" + link + "' that could be taken out");
  return left;
}

std::string with_elements(const std::string& xml, const std::string& elements) {
  const std::size_t end = xml.rfind("</robot>");
  if (end == std::string::npos) throw InputError("urdf_invalid", "the URDF has no </robot> at its end: it is damaged");
  return xml.substr(0, end) + elements + xml.substr(end);
}

std::string with_reference(const std::string& xml, const std::string& reference, const std::string& other) {
  std::string changed = xml;
  for (const char quote : {'"', '\''}) {
    const std::string old = quote + reference + quote, now = quote + other + quote;
    for (std::size_t at = 0; (at = changed.find(old, at)) != std::string::npos; at += now.size())
      changed.replace(at, old.size(), now);
  }
  return changed;
}

}  // namespace sculpt
