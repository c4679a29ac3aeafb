// The name under which the daemon introduces itself.
#pragma once

namespace sculpt {

inline constexpr const char* server_name = "sculptd 0.1.0";

}  // namespace sculpt
