#include "clients/cli/cell/xacro.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"

namespace sculpt::cli {
namespace {

namespace fs = std::filesystem;

/// A file without a name, for what a program says.
class Said {
 public:
  Said() : file_(std::tmpfile()) {
    if (file_ == nullptr) throw Failure(exit_failed, "file_unwritable", "no temporary file can be made");
  }
  ~Said() { std::fclose(file_); }
  Said(const Said&) = delete;
  Said& operator=(const Said&) = delete;

  int descriptor() const { return fileno(file_); }
  std::string text() const {
    std::rewind(file_);
    std::string all;
    std::array<char, 65536> part;
    for (std::size_t got; (got = std::fread(part.data(), 1, part.size(), file_)) > 0;) all.append(part.data(), got);
    return all;
  }

 private:
  std::FILE* file_;
};

using Packages = std::map<std::string, fs::path>;

/// The folders above the source, the nearest first.
std::vector<fs::path> folders_above(const fs::path& path) {
  std::vector<fs::path> folders;
  fs::path above = fs::absolute(path).lexically_normal().parent_path();
  for (int levels = 0; levels < 4 && above.has_relative_path(); ++levels, above = above.parent_path())
    folders.push_back(above);
  return folders;
}

/// What may be a package: those that are named, the folders above the source, and what lies beside these.
Packages find_packages(const fs::path& path, const Packages& named) {
  Packages packages;
  for (const auto& [name, folder] : named) packages[name] = fs::absolute(folder).lexically_normal();
  for (const fs::path& above : folders_above(path)) {
    packages.emplace(above.filename(), above);
    std::error_code unreadable;
    for (const fs::directory_entry& beside : fs::directory_iterator(above, unreadable))
      if (beside.is_directory(unreadable)) packages.emplace(beside.path().filename(), beside.path());
  }
  return packages;
}

/// Packages as ROS 2 finds them: a folder with an entry and a link for each. Gone with this object.
class AmentPrefix {
 public:
  explicit AmentPrefix(const Packages& packages) {
    std::string pattern = (fs::temp_directory_path() / "sculpt-xacro-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw Failure(exit_failed, "file_unwritable", "no temporary folder can be made in " + pattern);
    folder_ = pattern;
    const fs::path index = folder_ / "share/ament_index/resource_index/packages";
    fs::create_directories(index);
    for (const auto& [name, package] : packages) {
      std::ofstream(index / name).flush();
      fs::create_directory_symlink(package, folder_ / "share" / name);
    }
  }
  ~AmentPrefix() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  AmentPrefix(const AmentPrefix&) = delete;
  AmentPrefix& operator=(const AmentPrefix&) = delete;

  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

/// For ROS 1: where it looks for packages.
std::string package_path(const fs::path& path, const Packages& named) {
  std::string list;
  const auto add = [&](const fs::path& folder) { list += (list.empty() ? "" : ":") + folder.string(); };
  for (const auto& [name, folder] : named) add(fs::absolute(folder).lexically_normal());
  for (const fs::path& above : folders_above(path)) add(above);
  return list;
}

/// Of this process, with these lists of folders before what it has there.
std::vector<std::string> environment_with(std::map<std::string, std::string> lists) {
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry, name = text.substr(0, text.find('='));
    const auto list = lists.find(name);
    if (list == lists.end())
      environment.push_back(text);
    else if (text.size() > name.size() + 1)
      list->second.append(list->second.empty() ? "" : ":").append(text, name.size() + 1);
  }
  environment.reserve(environment.size() + lists.size());
  for (const auto& [name, value] : lists) environment.push_back(name + "=" + value);
  return environment;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \n\r\t");
  if (end == std::string::npos) return "it said nothing";
  const std::size_t begin = text.rfind('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

}  // namespace

bool is_xacro(const fs::path& path, const std::string& text) {
  return path.extension() == ".xacro" || text.find("<xacro:") != std::string::npos;
}

std::string run_xacro(const fs::path& path, const std::map<std::string, fs::path>& packages) {
  const Said out, wrong;
  const AmentPrefix prefix(find_packages(path, packages));
  std::vector<std::string> words{"xacro", path.string()};
  std::vector<std::string> settings = environment_with(
      {{"ROS_PACKAGE_PATH", package_path(path, packages)}, {"AMENT_PREFIX_PATH", prefix.folder().string()}});
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, wrong.descriptor(), STDERR_FILENO);
  pid_t process = 0;
  const int refused =
      posix_spawnp(&process, "xacro", &files, nullptr, pointers(words).data(), pointers(settings).data());
  posix_spawn_file_actions_destroy(&files);
  if (refused != 0)
    throw Failure(exit_usage, "xacro_missing",
                  path.string() +
                      " is a xacro source, and the program xacro that writes it out is not installed: install it (it "
                      "comes with ROS, and as the Python package xacro), or write the URDF out where it is: xacro " +
                      path.filename().string() + " > robot.urdf");
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return out.text();
  throw Failure(exit_usage, "xacro_failed",
                "xacro cannot write " + path.string() + " out: " + last_line(wrong.text()) +
                    " (name the packages that it includes with --package NAME=FOLDER)");
}

}  // namespace sculpt::cli
