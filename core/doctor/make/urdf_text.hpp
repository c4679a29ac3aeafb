// A URDF as text with the places of its links and joints: to take some out and to put others in. Roughly parsed: what
// comes of it goes through parse_urdf.
#pragma once

#include <string>
#include <vector>

namespace sculpt {

/// A `<link>` or `<joint>` right below `<robot>`, and where it stands in the text.
struct UrdfElement {
  std::string tag, name;
  std::string parent, child;  ///< links of a joint
  std::size_t begin = 0, end = 0;
};

/// In the order of the text. Comments and CDATA are passed over.
std::vector<UrdfElement> urdf_elements(const std::string& xml);

/// Without the link, what hangs on it, and the joints of all these. Throws InputError `urdf_invalid` where there is no
/// such link.
std::string without_branch(const std::string& xml, const std::string& link);

/// With more elements at its end. Throws InputError `urdf_invalid` where `</robot>` is missing.
std::string with_elements(const std::string& xml, const std::string& elements);

/// With another reference in each filename="REFERENCE".
std::string with_reference(const std::string& xml, const std::string& reference, const std::string& other);

}  // namespace sculpt
