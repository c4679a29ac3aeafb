#include "server/confine/file_fence.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

namespace sculpt::server {
namespace {

// Newer than the header of Debian 12.
constexpr std::uint64_t truncate_right = 1ull << 14;
constexpr int first_with_refer = 2, first_with_truncate = 3;

constexpr std::uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t writing =
    LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_REMOVE_FILE | truncate_right;

/// All rights that the kernel knows: what is not among them cannot be forbidden.
std::uint64_t known_rights(long version) {
  std::uint64_t rights = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;
  if (version >= first_with_refer) rights |= LANDLOCK_ACCESS_FS_REFER;
  if (version >= first_with_truncate) rights |= truncate_right;
  return rights;
}

class Ruleset {
 public:
  explicit Ruleset(std::uint64_t handled) {
    const landlock_ruleset_attr attributes{handled};
    file_ = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
  }
  ~Ruleset() {
    if (file_ >= 0) ::close(file_);
  }
  Ruleset(const Ruleset&) = delete;
  Ruleset& operator=(const Ruleset&) = delete;

  void allow(const std::filesystem::path& path, std::uint64_t rights) const {
    const int place = ::open(path.c_str(), O_PATH | O_CLOEXEC);
    if (place < 0) return;
    const landlock_path_beneath_attr rule{rights, place};
    ::syscall(SYS_landlock_add_rule, file_, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
    ::close(place);
  }
  bool enforce() const { return file_ >= 0 && ::syscall(SYS_landlock_restrict_self, file_, 0) == 0; }

 private:
  int file_ = -1;
};

}  // namespace

int fence_files(const std::filesystem::path& folder, bool writes) {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 0) return errno;
  const std::uint64_t known = known_rights(version);
  const Ruleset rules(known);
  // What cannot be allowed is forbidden like the rest.
  rules.allow("/proc/self/exe", LANDLOCK_ACCESS_FS_READ_FILE);
  if (!folder.empty()) rules.allow(folder, (writes ? reading | writing : reading) & known);
  return rules.enforce() ? 0 : errno;
}

}  // namespace sculpt::server
