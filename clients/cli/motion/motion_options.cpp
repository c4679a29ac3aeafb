#include "clients/cli/motion/motion_options.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/job_options.hpp"
#include "core/base/extension.hpp"

namespace sculpt::cli {

namespace fs = std::filesystem;

namespace {

/// Removed again when it has been read.
class TemporaryFile {
 public:
  TemporaryFile() {
    std::string name = (fs::temp_directory_path() / "sculpt-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0)
      throw Failure(exit_usage, "file_unwritable",
                    "cannot write to " + fs::temp_directory_path().string() + ": check its space and permissions");
    close(file);
    path_ = name;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool is_file(const std::string& subject) {
  const std::string extension = extension_of(subject);
  return extension == "ndjson" || extension == "sct" || fs::exists(subject);
}

}  // namespace

void add_motion_options(CLI::App& command, MotionOptions& options) {
  command.add_option("plan", options.subject, "A trajectory (.ndjson or .sct), or the id of a job")
      ->type_name("PLAN|JOB")
      ->required();
  command
      .add_option("--robot", options.robot,
                  "The cell that it was planned for; without it that of the job, or the one that the file names")
      ->type_name("CELL");
  command
      .add_option_function<double>(
          "--feed",
          [&options](const double& feed_m_s) {
            options.feed_m_s = feed_m_s;
            options.has_feed = true;
          },
          "Speed of the ball while it cuts; milling tools go no faster than their own, and need none")
      ->type_name("M_S");
  command.add_option("--rapid", options.rapid_m_s, "Speed of the ball on moves")
      ->type_name("M_S")
      ->capture_default_str();
  command
      .add_option("--keep-feed", options.keep_feed,
                  "Refuse, with the place, unless every cut keeps this share of the feed; the first and last voxel of "
                  "cuts along one line do not count")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--reserve-um", options.reserve_um,
                  "Of what the certificates leave, keep so much free for what rounds joint values later")
      ->type_name("UM")
      ->check(CLI::NonNegativeNumber);
}

MotionDemands to_demands(const MotionOptions& options, const PlanPath& path) {
  double feed_m_s = options.feed_m_s;
  if (!options.has_feed) {
    if (!path.header().mill) throw Failure(exit_usage, "usage", "--feed is required: a thin tool has none of its own");
    for (const MillTool& tool : path.header().mill->tools) feed_m_s = std::max(feed_m_s, tool.feed_m_s);
  }
  MotionDemands demands{feed_m_s, options.rapid_m_s, {}, options.reserve_um * 1e-6};
  if (options.keep_feed > 0) demands.keep_feed = options.keep_feed;
  return demands;
}

PlanPath read_path(const std::string& server, const MotionOptions& options) {
  if (is_file(options.subject)) {
    std::error_code ignored;
    if (!fs::is_regular_file(options.subject, ignored)) {  // a pipe, or says what is wrong
      std::istringstream in(read_input(options.subject, "trajectory"));
      return PlanPath(in);
    }
    std::ifstream in(options.subject, std::ios::binary);
    return PlanPath(in);
  }
  const TemporaryFile copy;
  {
    client::Client client = connect(server);
    std::ofstream out(copy.path(), std::ios::binary);
    client::ArtifactRequest request;
    request.job = options.subject;
    request.artifact = "trajectory";
    request.format = "binary";
    client.read_artifact(request, out);
  }
  std::ifstream in(copy.path(), std::ios::binary);
  return PlanPath(in);
}

Cell read_cell_of(const std::string& server, const PlanPath& path, const MotionOptions& options) {
  if (!options.robot.empty()) return parse_cell(read_cell(options.robot));
  if (is_file(options.subject)) return parse_cell(read_cell(path.header().cell));
  client::JobCell cell = connect(server).read_cell(options.subject);
  return parse_cell(CellFiles{std::move(cell.name), std::move(cell.cell_json), std::move(cell.files)});
}

}  // namespace sculpt::cli
