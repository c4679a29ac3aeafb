// What is in the way.
#pragma once

namespace sculpt {

/// What a configuration or an edge runs into; `limits` = outside the joint limits.
enum class Contact { none, limits, tool_material, link_material, link_link };

}  // namespace sculpt
