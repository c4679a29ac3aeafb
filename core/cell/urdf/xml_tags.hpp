// The tags of an XML text and their places in it: to change some of a maker's file and leave the rest as it is, byte
// for byte. Roughly read: what comes of it goes through parse_urdf.
#pragma once

#include <optional>
#include <string_view>

namespace sculpt {

/// A start tag, end tag or empty tag of a text that outlives it.
struct XmlTag {
  std::size_t begin = 0, end = 0;  ///< from its '<' to behind its '>', in the text
  std::string_view text;

  bool closes() const;    ///< `</name>`
  bool is_empty() const;  ///< `<name/>`
  std::string_view name() const;
  /// As it stands there, entities and all.
  std::optional<std::string_view> attribute(std::string_view called) const;
};

/// The first that begins at `at` or behind it. Comments, CDATA, declarations and instructions are passed over; nothing
/// where there is no tag any more, or the last one is cut.
std::optional<XmlTag> next_tag(std::string_view xml, std::size_t at);

}  // namespace sculpt
