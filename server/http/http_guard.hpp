// Keeps web pages of strangers out: a browser that was lured here says so in Host and Origin.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sculpt::server {

/// The host of "HOST[:PORT]" or "[V6][:PORT]", in lower case; empty where the text is neither.
std::string host_of(std::string_view authority);

/// Whether a request may name this host: localhost, a loopback address, one of `names`. A name that an attacker pointed
/// at this machine (DNS rebinding) is none of these.
bool host_allowed(std::string_view host_header, const std::vector<std::string>& names);

/// Whether a page of this origin may call: none (no browser, or no foreign page), the same host and port, or one of
/// `origins`.
bool origin_allowed(std::string_view origin, std::string_view host_header, const std::vector<std::string>& origins);

}  // namespace sculpt::server
