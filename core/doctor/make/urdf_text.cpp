#include "core/doctor/make/urdf_text.hpp"

#include <set>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Value of an attribute in the text of a tag; empty where it is missing.
std::string attribute(const std::string& tag, const std::string& name) {
  for (std::size_t at = tag.find(name); at != std::string::npos; at = tag.find(name, at + 1)) {
    if (at == 0 || !is_blank(tag[at - 1])) continue;
    std::size_t after = at + name.size();
    while (after < tag.size() && is_blank(tag[after])) ++after;
    if (after >= tag.size() || tag[after] != '=') continue;
    const std::size_t open = tag.find_first_of("\"'", after);
    if (open == std::string::npos) return {};
    const std::size_t close = tag.find(tag[open], open + 1);
    return close == std::string::npos ? std::string() : tag.substr(open + 1, close - open - 1);
  }
  return {};
}

/// One tag, with its angle brackets.
struct Tag {
  std::size_t begin = 0, end = 0;
  std::string text;

  bool closes() const { return text.starts_with("</"); }
  bool is_empty() const { return text.ends_with("/>"); }
  std::string name() const {
    std::size_t at = closes() ? 2 : 1, last = at;
    while (last < text.size() && !is_blank(text[last]) && text[last] != '>' && text[last] != '/') ++last;
    return text.substr(at, last - at);
  }
};

/// Goes from one tag to the next; what is no element is passed over.
class Tags {
 public:
  explicit Tags(const std::string& xml) : xml_(xml) {}

  bool next(Tag& tag) {
    while ((at_ = xml_.find('<', at_)) != std::string::npos) {
      if (skip("<!--", "-->") || skip("<![CDATA[", "]]>") || skip("<?", "?>") || skip("<!", ">")) continue;
      tag.begin = at_;
      char quote = 0;
      for (; at_ < xml_.size() && (quote != 0 || xml_[at_] != '>'); ++at_)
        if (quote != 0 ? xml_[at_] == quote : xml_[at_] == '"' || xml_[at_] == '\'') quote = quote != 0 ? 0 : xml_[at_];
      tag.end = at_ = std::min(xml_.size(), at_ + 1);
      tag.text = xml_.substr(tag.begin, tag.end - tag.begin);
      return true;
    }
    return false;
  }

 private:
  bool skip(const std::string& open, const std::string& close) {
    if (xml_.compare(at_, open.size(), open) != 0) return false;
    const std::size_t end = xml_.find(close, at_ + open.size());
    at_ = end == std::string::npos ? xml_.size() : end + close.size();
    return true;
  }

  const std::string& xml_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<UrdfElement> urdf_elements(const std::string& xml) {
  std::vector<UrdfElement> found;
  Tags tags(xml);
  int depth = 0;
  for (Tag tag; tags.next(tag);) {
    if (tag.closes()) {
      if (--depth == 1 && !found.empty()) found.back().end = tag.end;
      continue;
    }
    if (depth == 1) found.push_back({tag.name(), attribute(tag.text, "name"), {}, {}, tag.begin, tag.end});
    if (depth == 2 && tag.name() == "parent") found.back().parent = attribute(tag.text, "link");
    if (depth == 2 && tag.name() == "child") found.back().child = attribute(tag.text, "link");
    if (!tag.is_empty()) ++depth;
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
