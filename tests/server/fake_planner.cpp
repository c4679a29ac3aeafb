#include "tests/server/fake_planner.hpp"

#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <new>
#include <ostream>
#include <thread>

#include "core/law/law_file.hpp"
#include "proto/json.hpp"
#include "tests/server/fake_motion.hpp"

namespace sculpt::server {

void Gate::open() {
  {
    const std::lock_guard lock(mutex_);
    open_ = true;
  }
  opened_.notify_all();
}

void Gate::pass(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  if (!opened_.wait(lock, std::move(stop), [this] { return open_; })) throw Cancelled{};
}

namespace {

// What a run gets hold of that is none of its business.
std::string spy(const std::filesystem::path& trajectory) {
  const std::filesystem::path data = trajectory.parent_path().parent_path().parent_path();
  std::string found;
  if (std::ifstream(data / "tokens.json")) found += " tokens";
  if (std::ofstream(data / "jobs" / "new")) found += " other folders";
  std::error_code refused;
  const std::filesystem::directory_iterator blobs(data / "blobs", refused);
  if (!refused) found += " blobs";
  if (::environ != nullptr && *::environ != nullptr) found += " the environment";
  if (::socket(AF_INET, SOCK_STREAM, 0) >= 0) found += " the network";
  if (::kill(::getppid(), 0) == 0) found += " the daemon";
  struct stat own {
  }, other{};
  ::stat(trajectory.c_str(), &own);
  for (int file = STDERR_FILENO + 1; file < 64; ++file)
    if (::fstat(file, &other) == 0 && S_ISREG(other.st_mode) && other.st_ino != own.st_ino) found += " an open file";
  return found.empty() ? "nothing" : found;
}

// Where its target stands in which stock.
std::string seen(const Job& job) {
  Json clampings = Json::array();
  for (const Clamping& clamping : job.clampings) clampings.push_back(clamping.left.bytes);
  return proto::write_json(
      {{"margin_m", job.placement.margin_m}, {"box", job.stock.box.has_value()}, {"clampings", std::move(clampings)}});
}

}  // namespace

PlanFiles FakePlanner::run(const Job& job, const std::filesystem::path& trajectory, const Watch& watch) {
  ++runs;
  const std::string& wish = job.mesh.bytes;
  watch.step(Stage::load, 0, 1);
  std::ofstream out(trajectory, std::ios::binary | std::ios::trunc);
  out << fake_header << std::flush;
  watch.step(Stage::plan, 1, 2);
  if (wish == "hold") gate.pass(watch.stop);
  if (wish == "fails") throw InputError("no_transit", "there is no way");
  if (wish == "spies") throw InputError("spied", spy(trajectory));
  if (wish == "throws") throw std::runtime_error("a fault");
  if (wish == "no memory") throw std::bad_alloc();
  if (wish == "segfault") {
    ::signal(SIGSEGV, SIG_DFL);  // a sanitizer would make an exit code of it
    ::raise(SIGSEGV);
  }
  if (wish == "abort") std::abort();
  if (wish == "exit") std::_Exit(0);
  if (wish == "deaf") std::this_thread::sleep_for(std::chrono::hours(24));
  if (wish == "prints") std::cout << "a library has something to say\n" << std::flush;
  if (wish == "big") {
    for (int i = 0; i < 8; ++i) out << std::string((1 << 20) - 1, static_cast<char>('a' + i)) << "\n";
  }
  out << fake_end << std::flush;
  std::ofstream(trajectory.parent_path() / timeline_file) << fake_timeline;
  watch.step(Stage::verify, 2, 2);
  PlanFiles files;
  files.report_json = "{\"mesh\":\"" + job.mesh.name + "\",\"robot\":\"" + job.cell.name +
                      "\",\"threads\":" + std::to_string(job.threads) + ",\"seen\":" + seen(job) + "}";
  files.residue_ndjson = "{\"voxel\":[0,0,0],\"reason\":\"enclosed\"}\n";
  files.voxels_binvox = "#binvox 1\n";
  files.stock_binvox = "left of " + wish + " 1";
  files.clean = wish != "unclean";
  files.collisions = files.clean ? 0 : 3;
  if (!files.clean) files.first_finding = "tool touches keep";
  return files;
}

Planner FakePlanner::planner() {
  Planner planner;
  planner.cells = [] { return std::vector<std::string>{"gantry"}; };
  planner.read_cell = [](const std::string& name) {
    if (name != "gantry") throw InputError("cell_unknown", "there is no cell '" + name + "': there is gantry");
    return CellFiles{name, "{}", {{"room.urdf", "<robot/>"}}};
  };
  planner.tool_libraries = [] {
    return std::vector<ToolLibraryFile>{{"carving", R"({"tools":[]})"}, {"torn", R"({"tools":)"}};
  };
  planner.check = [](const Job& job, const Watch&) {
    if (job.mesh.bytes == "crashes its reader") std::abort();
    if (job.mesh.bytes == "has no end") std::this_thread::sleep_for(std::chrono::hours(24));
    if (job.mesh.bytes == "bad input") throw InputError("mesh_unreadable", "the file is no mesh");
  };
  planner.predict_memory = [](const JobSizes& sizes) { return sizes.mesh.bytes; };
  planner.run = [this](const Job& job, const std::filesystem::path& path, const Watch& watch) {
    return run(job, path, watch);
  };
  planner.examine = [](const CellFiles& cell, int resolution, int) {
    if (cell.name == "crashes its reader") std::abort();
    if (cell.name == "has no end") std::this_thread::sleep_for(std::chrono::hours(24));
    return "{\"cell\":\"" + cell.name + "\",\"resolution\":" + std::to_string(resolution) + "}";
  };
  planner.verify = [](const Job& job, const std::filesystem::path&, const Watch&) {
    Replay replay{job.mesh.bytes != "unclean", 0, 7, {}, {{"base", "arm", "a bearing"}}};
    if (!replay.clean) replay.collisions = 3;
    if (!replay.clean) replay.findings.push_back({2, "tool touches keep"});
    return replay;
  };
  planner.time = [](const Job& job, const std::filesystem::path& trajectory, const std::filesystem::path& law) {
    const double feed_m_s = job.motion->feed_m_s.value_or(0);
    if (feed_m_s == feed_refused) throw InputError("feed_invalid", "no such feed");
    if (feed_m_s == feed_crashes) std::abort();
    if (feed_m_s == feed_endless) std::this_thread::sleep_for(std::chrono::hours(24));
    if (feed_m_s == feed_writes_none) return;
    std::ifstream in(trajectory, std::ios::binary);
    const PlanPath path(in);
    PlanMark mark = mark_of(path);
    if (feed_m_s == feed_of_another_plan) ++mark.crc;
    std::ofstream out(law, std::ios::binary);
    write_law(out, fake_law(path, feed_m_s), mark);
  };
  planner.program = [](const Job& job, const ProgramDemands& demands, const std::filesystem::path&,
                       const std::filesystem::path& zip) {
    if (demands.name == "refused") throw InputError("axes_unfit", "no such program can be written for this cell");
    if (demands.name == "crashes") std::abort();
    if (demands.name == "endless") std::this_thread::sleep_for(std::chrono::hours(24));
    if (demands.name == "writes_none") return;
    std::ofstream(zip) << facts_of(demands.dialect).name << ' ' << demands.name << ' '
                       << job.motion->feed_m_s.value_or(0) << " of " << job.mesh.bytes;
  };
  const auto leave = [](const char* what) {
    return [what](const Job& job, const std::filesystem::path&, const std::filesystem::path& file) {
      if (job.mesh.bytes == "surface refused") throw InputError("mesh_unreadable", "the file is no mesh");
      std::ofstream(file) << what << " of " << job.mesh.bytes;
    };
  };
  planner.surface = leave("surface");
  planner.stocks = leave("stocks");
  planner.to_csv = [](std::istream& in, std::ostream& out) { out << "csv\n" << in.rdbuf(); };
  planner.to_binary = [](std::istream& in, std::ostream& out) { out << "sct\n" << in.rdbuf(); };
  return planner;
}

}  // namespace sculpt::server
