// The only door to Asio's headers, because two things must come before them.
#pragma once

#include <utility>  // forgotten by Asio 1.74 on GCC 12

// ThreadSanitizer does not understand fences; Asio's queue is guarded by a mutex as well, so nothing is lost without
// them.
#ifdef __SANITIZE_THREAD__
#define BOOST_ASIO_DISABLE_FENCED_BLOCK
#endif

#include <boost/asio/buffer.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>

namespace sculpt::server {
namespace net = boost::asio;
}  // namespace sculpt::server
