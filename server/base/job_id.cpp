#include "server/base/job_id.hpp"

#include <random>
#include <string_view>

namespace sculpt::server {
namespace {

constexpr std::string_view letters = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
constexpr int time_letters = 10;
constexpr int random_letters = 16;

std::string fresh_id(std::uint64_t now_ms) {
  std::string id(time_letters + random_letters, '0');
  for (int i = time_letters - 1; i >= 0; --i, now_ms >>= 5) id[static_cast<std::size_t>(i)] = letters[now_ms & 31];
  std::random_device random;
  for (int i = time_letters; i < time_letters + random_letters; ++i)
    id[static_cast<std::size_t>(i)] = letters[random() & 31];
  return id;
}

// The next id in order: adds one in base 32.
std::string successor(std::string id) {
  for (std::size_t i = id.size(); i-- > 0;) {
    const std::size_t digit = letters.find(id[i]);
    if (digit + 1 < letters.size()) {
      id[i] = letters[digit + 1];
      return id;
    }
    id[i] = letters[0];
  }
  return id;
}

}  // namespace

std::string IdMaker::next(std::uint64_t now_ms) {
  std::string id = fresh_id(now_ms);
  if (id <= last_) id = successor(last_);
  last_ = id;
  return id;
}

}  // namespace sculpt::server
