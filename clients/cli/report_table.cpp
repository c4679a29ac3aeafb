#include "clients/cli/report_table.hpp"

#include <cstdio>

namespace sculpt::cli {

namespace {

std::string fixed(double value, int digits, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f%s", digits, value, unit);
  return text;
}

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fixed(value.get<double>(), 3, "");
  return value.dump();
}

void row(std::string& table, const std::string& label, const std::string& value) {
  constexpr std::size_t width = 22;
  table += label + std::string(label.size() < width ? width - label.size() : 2, ' ') + value + "\n";
}

/// A row per field of `object` that is there: `fields` are pairs of field and label.
void rows(std::string& table, const Json& object, std::initializer_list<std::pair<const char*, const char*>> fields) {
  for (const auto& [field, label] : fields)
    if (object.contains(field)) row(table, label, text_of(object[field]));
}

std::string percent(const Json& part, const Json& whole) {
  const double all = whole.get<double>();
  return part.dump() + (all > 0 ? "  (" + fixed(100 * part.get<double>() / all, 2, " %)") : "");
}

void voxel_rows(std::string& table, const Json& report) {
  if (!report.contains("voxels")) return;
  const Json& voxels = report["voxels"];
  rows(table, voxels, {{"total", "voxels"}, {"air", "  air"}, {"keep", "  keep"}, {"remove", "  remove"}});
  const Doubts doubts{voxels.value("keep", std::uint64_t{0}),
                      voxels.value("loose_keep", std::uint64_t{0}),
                      voxels.value("ambiguous", std::uint64_t{0}),
                      {}};
  if (doubts.loose_keep > 0)
    row(table, "  loose keep",
        std::to_string(doubts.loose_keep) + (doubts.is_much_loose() ? "  (warning: " : "  (") +
            "hangs on nothing once all around it is gone; pieces: " + voxels.value("loose_keep_pieces", Json()).dump() +
            ")");
  if (doubts.ambiguous > 0)
    row(table, "  ambiguous",
        std::to_string(doubts.ambiguous) + "  (warning: the mesh does not say for sure whether they are inside)");
  if (const auto freed = voxels.value("freed", std::uint64_t{0}); freed > 0)
    row(table, "  freed", std::to_string(freed) + "  (warning: comes loose while it is carved, and will fall)");
  if (!voxels.contains("removed") || !voxels.contains("residue") || !voxels.contains("remove")) return;
  row(table, "  removed", percent(voxels["removed"], voxels["remove"]));
  row(table, "  residue", percent(voxels["residue"], voxels["remove"]));
  for (const Json& part : report.value("residue", Json::array()))
    row(table, "    " + part.value("reason", ""), part.value("voxels", Json()).dump());
}

void path_rows(std::string& table, const Json& report) {
  if (report.contains("octree"))
    rows(table, report["octree"], {{"leaves", "octree leaves"}, {"remove_leaves", "  to remove"}});
  if (!report.contains("path")) return;
  const Json& path = report["path"];
  rows(table, path, {{"keyframes", "keyframes"}, {"rows", "rows"}, {"transits", "transits"}});
  if (path.contains("cut_m")) row(table, "cut", fixed(path["cut_m"].get<double>(), 3, " m"));
  if (path.contains("travel_m")) row(table, "travel", fixed(path["travel_m"].get<double>(), 3, " m"));
  if (path.contains("joint_travel_rad"))
    row(table, "joint travel", fixed(path["joint_travel_rad"].get<double>(), 1, " rad"));
  if (report.contains("sweep"))
    rows(table, report["sweep"],
         {{"cut", "cut by sweeps"}, {"left", "left to octree"}, {"uncovered", "  no field there"}});
  if (report.contains("quality"))
    rows(table, report["quality"],
         {{"moves_per_voxel", "moves a voxel"},
          {"turns", "turns"},
          {"ompl_calls", "OMPL calls"},
          {"ompl_solved", "  solved"},
          {"checks_per_voxel", "checks a voxel"}});
}

/// A line per tool, and what they leave on the surface. Lengths in millimetres.
void mill_rows(std::string& table, const Json& report) {
  for (const Json& tool : report.value("tools", Json::array()))
    row(table, "tool " + tool.value("name", ""),
        fixed(1e6 * tool.value("removed_m3", 0.0), 1, " cm3, ") + fixed(tool.value("cut_m", 0.0), 1, " m cut, ") +
            fixed(tool.value("travel_m", 0.0), 1, " m beside, ") + std::to_string(tool.value("keyframes", 0)) +
            " keyframes, " + std::to_string(tool.value("runs", 0)) + " runs");
  for (const Json& cure : report.value("cures", Json::array()))
    row(table, "  left", fixed(100 * cure.value("share", 0.0), 0, " %: ") + cure.value("cure", ""));
  if (!report.contains("surface")) return;
  const Json& surface = report["surface"];
  const auto excess_row = [&](const char* label, const Json& part) {
    const Json excess = part.value("excess_m", Json::object());
    const auto mm = [&](const char* field) { return fixed(1000 * excess.value(field, 0.0), 3, ""); };
    row(table, label,
        percent(part.value("within_tolerance", Json(0)), part.value("points", Json(0))) + " within tolerance; p50 " +
            mm("p50") + ", p95 " + mm("p95") + ", p99 " + mm("p99") + ", max " + mm("max") + " mm");
  };
  excess_row("surface", surface);
  if (surface.contains("reachable")) excess_row("  reachable", surface["reachable"]);
  row(table, "  gouged",
      surface.value("gouged_points", Json(0)).dump() + " points, by up to " +
          fixed(1000 * surface.value("gouge_m", 0.0), 4, " mm"));
}

/// How long it takes at the feed that the job asked for; `sculpt time` tells the rest.
void time_rows(std::string& table, const Json& report) {
  if (!report.contains("time")) return;
  const Json& time = report["time"];
  row(table, "time",
      fixed(time.value("total_s", 0.0), 1, " s, ") + fixed(time.value("ratio", 0.0), 3, "") +
          " of what the caps alone would take");
  row(table, "  at most",
      fixed(1000 * time.value("feed_m_s", 0.0), 1, " mm/s on cuts, ") +
          fixed(1000 * time.value("rapid_m_s", 0.0), 1, " mm/s on moves"));
  const Json by = time.value("by", Json::object());
  for (const char* cause : {"feed", "rapid"})
    row(table, std::string("  ") + cause, fixed(by.value(cause, 0.0), 1, " s"));
  for (const char* cause : {"velocity", "acceleration", "jerk"}) {
    const Json joints = by.value(cause, Json::object());
    for (const auto& [joint, seconds] : joints.items())
      if (seconds.get<double>() > 0) row(table, std::string("  ") + cause + " " + joint, fixed(seconds, 1, " s"));
  }
  const Json worst = time.value("worst", Json::array());
  if (worst.empty()) return;
  row(table, "  slowest cut",
      fixed(1000 * worst[0].value("feed_m_s", 0.0), 2, " mm/s at keyframe ") +
          text_of(worst[0].value("keyframe", Json())) + ", " + worst[0].value("joint", ""));
}

/// A line per pair of links that may touch.
void link_rows(std::string& table, const Json& report) {
  const char* label = "links not kept apart";
  for (const Json& pair : report.value("unchecked_links", Json::array())) {
    const Json links = pair.value("links", Json::array());
    if (links.size() != 2) continue;
    row(table, label, text_of(links[0]) + ", " + text_of(links[1]) + ": " + pair.value("why", ""));
    label = "";
  }
}

void run_rows(std::string& table, const Json& report) {
  const Json seconds = report.value("seconds", Json::object());
  for (const auto& [stage, value] : seconds.items()) row(table, "seconds " + stage, fixed(value.get<double>(), 3, ""));
  if (report.contains("peak_memory_bytes"))
    row(table, "peak memory", fixed(report["peak_memory_bytes"].get<double>() / 1048576.0, 1, " MiB"));
  rows(table, report, {{"threads", "threads"}, {"plan_sha256", "plan sha256"}});
  if (!report.contains("verify")) return;
  const Json& verify = report["verify"];
  const bool clean = verify.value("clean", false);
  row(table, "verify",
      std::string(clean ? "clean" : "NOT CLEAN") + ", " + verify.value("collisions", Json(0)).dump() + " findings, " +
          verify.value("voxels_checked", Json(0)).dump() + " voxels checked");
}

}  // namespace

std::vector<std::string> doubt_lines(const Doubts& doubts) {
  std::vector<std::string> lines;
  if (doubts.loose_keep > 0)
    lines.push_back((doubts.is_much_loose() ? "warning: " : "note: ") + std::to_string(doubts.loose_keep) + " of " +
                    std::to_string(doubts.keep) + " voxels of the target hang on nothing once all around them is gone" +
                    (doubts.is_much_loose() ? ": make them reach the floor of the stock" : ""));
  const auto& [x, y, z] = doubts.ambiguous_at_mm;
  if (doubts.ambiguous > 0)
    lines.push_back("warning: of " + std::to_string(doubts.ambiguous) +
                    " voxels the mesh does not say for sure whether they are inside (around " + fixed(x, 1, ", ") +
                    fixed(y, 1, ", ") + fixed(z, 1, " mm in the stock's frame") +
                    "): look at `sculpt voxelize`, and turn the surfaces of cavities inwards, all others outwards");
  return lines;
}

std::string report_table(const Json& report) {
  std::string table;
  rows(table, report,
       {{"job", "job"},
        {"state", "state"},
        {"mesh", "mesh"},
        {"robot", "robot"},
        {"search", "search"},
        {"seed", "seed"},
        {"resolution", "resolution"}});
  voxel_rows(table, report);
  path_rows(table, report);
  mill_rows(table, report);
  time_rows(table, report);
  link_rows(table, report);
  run_rows(table, report);
  return table;
}

}  // namespace sculpt::cli
