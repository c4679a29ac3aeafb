#include "core/plan/checkpoint/checkpoint.hpp"

#include <nlohmann/json.hpp>

#include "core/base/sha256.hpp"
#include "core/plan/checkpoint/mill_json.hpp"
#include "core/plan/checkpoint/path_json.hpp"

namespace sculpt {
namespace {

using Json = nlohmann::json;

constexpr std::size_t hash_length = 64;

Json to_json(Voxel v) {
  return {v.i, v.j, v.k};
}

Voxel voxel_of(const Json& json) {
  return {json.at(0).get<int>(), json.at(1).get<int>(), json.at(2).get<int>()};
}

Json to_json(const TrajectoryStart& file) {
  return {{"keyframes", file.keyframes}, {"bytes", file.bytes}, {"sha256", file.sha256}};
}

TrajectoryStart start_of(const Json& json) {
  return {json.at("keyframes").get<std::uint64_t>(), json.at("bytes").get<std::uint64_t>(),
          json.at("sha256").get<std::string>()};
}

Json to_json(const std::vector<Voxel>& voxels) {
  Json json = Json::array();
  for (const Voxel v : voxels) json.push_back(to_json(v));
  return json;
}

std::vector<Voxel> voxels_of(const Json& json) {
  std::vector<Voxel> voxels;
  for (const Json& v : json) voxels.push_back(voxel_of(v));
  return voxels;
}

Json to_json(const std::vector<Columns::Run>& runs) {
  Json json = Json::array();
  for (const Columns::Run& run : runs) json.push_back({run.first, run.last, run.b, run.c});
  return json;
}

std::vector<Columns::Run> runs_of(const Json& json) {
  std::vector<Columns::Run> runs;
  for (const Json& run : json)
    runs.push_back({run.at(0).get<int>(), run.at(1).get<int>(), run.at(2).get<int>(), run.at(3).get<int>()});
  return runs;
}

Json to_json(const StraightMark& pass) {
  return {{"layer", pass.layer},
          {"layers_at_once", pass.layers_at_once},
          {"given_up", to_json(pass.given_up)},
          {"held_here", to_json(pass.held_here)},
          {"cut_since", pass.cut_since},
          {"cut", pass.so_far.cut},
          {"spared", pass.so_far.spared}};
}

StraightMark pass_of(const Json& json) {
  return {json.at("layer").get<int>(),      json.at("layers_at_once").get<std::size_t>(),
          runs_of(json.at("given_up")),     runs_of(json.at("held_here")),
          json.at("cut_since").get<bool>(), {json.at("cut").get<bool>(), json.at("spared").get<bool>()}};
}

Json to_json(const SweepMemory& sweeping) {
  const Vec3& at = sweeping.arm.at;
  Json json{{"used_up", sweeping.used_up},
            {"spared", sweeping.spared},
            {"tilted_fields", sweeping.tilted_fields},
            {"openings", Json::array()},
            {"asked_with", sweeping.asked_with},
            {"tilted", sweeping.tilted},
            {"cut_tilted", sweeping.cut_tilted},
            {"transits", sweeping.arm.transits},
            {"at", {at.x(), at.y(), at.z()}},
            {"way_home", path_json(sweeping.arm.way_home)}};
  for (const auto& [standing, wanted] : sweeping.openings)
    json["openings"].push_back({{"n", standing.n()}, {"standing", standing.words()}, {"wanted", wanted.words()}});
  if (sweeping.out_of_reach) json["out_of_reach"] = to_json(*sweeping.out_of_reach);
  if (sweeping.direction) json["direction"] = *sweeping.direction;
  if (sweeping.pass) json["pass"] = to_json(*sweeping.pass);
  return json;
}

SweepMemory sweeping_of(const Json& json) {
  SweepMemory sweeping;
  sweeping.used_up = json.at("used_up").get<std::vector<char>>();
  sweeping.spared = json.at("spared").get<std::vector<char>>();
  sweeping.tilted_fields = json.at("tilted_fields").get<std::vector<std::size_t>>();
  for (const Json& opening : json.at("openings")) {
    const VoxelSet none(opening.at("n").get<int>());
    auto& [standing, wanted] = sweeping.openings.emplace_back(Opening{none, none});
    standing.words() = opening.at("standing").get<Words>();
    wanted.words() = opening.at("wanted").get<Words>();
  }
  sweeping.asked_with = json.at("asked_with").get<std::uint64_t>();
  sweeping.tilted = json.at("tilted").get<bool>();
  sweeping.cut_tilted = json.at("cut_tilted").get<bool>();
  sweeping.arm.transits = json.at("transits").get<std::uint64_t>();
  for (int axis = 0; axis < 3; ++axis)
    sweeping.arm.at[axis] = json.at("at").at(static_cast<std::size_t>(axis)).get<double>();
  sweeping.arm.way_home = path_of(json.at("way_home"));
  if (json.contains("out_of_reach")) sweeping.out_of_reach = voxels_of(json.at("out_of_reach"));
  if (json.contains("direction")) sweeping.direction = json.at("direction").get<std::size_t>();
  if (json.contains("pass")) sweeping.pass = pass_of(json.at("pass"));
  return sweeping;
}

Json to_json(const SweptMark& swept) {
  return {{"keyframes", swept.keyframes}, {"out_of_tool_reach", to_json(swept.out_of_tool_reach)}};
}

SweptMark swept_of(const Json& json) {
  return {json.at("keyframes").get<std::uint64_t>(), voxels_of(json.at("out_of_tool_reach"))};
}

Json to_json(const std::vector<BlockTrial>& trials) {
  Json json = Json::array();
  for (const BlockTrial& trial : trials)
    json.push_back({trial.removed, trial.left, trial.at.i, trial.at.j, trial.at.k});
  return json;
}

std::vector<BlockTrial> trials_of(const Json& json) {
  std::vector<BlockTrial> trials;
  for (const Json& t : json)
    trials.push_back(
        {t.at(0).get<int>(), t.at(1).get<int>(), {t.at(2).get<int>(), t.at(3).get<int>(), t.at(4).get<int>()}});
  return trials;
}

Json to_json(const ArmMemory& arm) {
  Json hubs = Json::array();
  for (const auto& [axis, path] : arm.hubs) hubs.push_back({axis, path_json(path)});
  return {{"axis", arm.axis},
          {"outside", arm.outside},
          {"last_outside", arm.last_outside},
          {"hubs", std::move(hubs)},
          {"way_out", path_json(arm.way_out)},
          {"queries", arm.queries},
          {"ompl_calls", arm.ompl_calls},
          {"ompl_solved", arm.ompl_solved},
          {"in_vain", arm.in_vain},
          {"cut", arm.cut},
          {"iterations_left", arm.iterations_left}};
}

ArmMemory arm_of(const Json& json) {
  ArmMemory arm;
  arm.axis = json.at("axis").get<std::size_t>();
  arm.outside = json.at("outside").get<bool>();
  arm.last_outside = json.at("last_outside").get<std::uint64_t>();
  for (const Json& hub : json.at("hubs")) arm.hubs[hub.at(0).get<std::size_t>()] = path_of(hub.at(1));
  arm.way_out = path_of(json.at("way_out"));
  arm.queries = json.at("queries").get<std::uint64_t>();
  arm.ompl_calls = json.at("ompl_calls").get<std::uint64_t>();
  arm.ompl_solved = json.at("ompl_solved").get<std::uint64_t>();
  arm.in_vain = json.at("in_vain").get<std::uint64_t>();
  arm.cut = json.at("cut").get<std::uint64_t>();
  arm.iterations_left = json.at("iterations_left").get<std::uint64_t>();
  return arm;
}

Json to_json(const std::vector<Refusal>& refusals) {
  Json json = Json::array();
  for (const Refusal& each : refusals) json.push_back({each.keyframes, to_json(each.from), to_json(each.to)});
  return json;
}

std::vector<Refusal> refusals_of(const Json& json) {
  std::vector<Refusal> refusals;
  for (const Json& each : json)
    refusals.push_back({each.at(0).get<std::uint64_t>(), voxel_of(each.at(1)), voxel_of(each.at(2))});
  return refusals;
}

Json to_json(const std::vector<Residue>& residue) {
  Json json = Json::array();
  for (const Residue& left : residue)
    json.push_back({left.voxel.i, left.voxel.j, left.voxel.k, static_cast<int>(left.reason)});
  return json;
}

std::vector<Residue> residue_of(const Json& json) {
  std::vector<Residue> residue;
  for (const Json& left : json) residue.push_back({voxel_of(left), static_cast<Reason>(left.at(3).get<int>())});
  return residue;
}

Json to_json(const ReplayedPieces& replayed) {
  Json findings = Json::array();
  for (const Finding& finding : replayed.found.findings) findings.push_back({finding.line, finding.sentence});
  return {{"pieces", replayed.pieces},
          {"collisions", replayed.found.collisions},
          {"voxels_checked", replayed.found.voxels_checked},
          {"findings", std::move(findings)}};
}

ReplayedPieces replayed_of(const Json& json) {
  ReplayedPieces replayed;
  replayed.pieces = json.at("pieces").get<std::uint64_t>();
  replayed.found.collisions = json.at("collisions").get<std::uint64_t>();
  replayed.found.voxels_checked = json.at("voxels_checked").get<std::uint64_t>();
  for (const Json& finding : json.at("findings"))
    replayed.found.findings.push_back({finding.at(0).get<std::uint64_t>(), finding.at(1).get<std::string>()});
  return replayed;
}

Checkpoint checkpoint_of(const Json& json) {
  Checkpoint checkpoint{start_of(json.at("file")),
                        json.at("checks").get<std::uint64_t>(),
                        {},
                        {},
                        trials_of(json.at("trials")),
                        arm_of(json.at("arm")),
                        refusals_of(json.at("refusals")),
                        {},
                        replayed_of(json.at("replayed")),
                        {},
                        {},
                        {}};
  if (json.contains("sweeping")) checkpoint.sweeping = sweeping_of(json.at("sweeping"));
  if (json.contains("swept")) checkpoint.swept = swept_of(json.at("swept"));
  if (json.contains("sweep_figures")) {
    const Json& figures = json.at("sweep_figures");
    checkpoint.sweep_figures = {figures.at(0).get<std::uint64_t>(), figures.at(1).get<std::uint64_t>(),
                                figures.at(2).get<std::uint64_t>()};
  }
  if (json.contains("milling")) checkpoint.milling = milling_of(json.at("milling"));
  if (json.contains("milled")) checkpoint.milled = milled_of(json.at("milled"));
  if (json.contains("residue")) checkpoint.residue = residue_of(json.at("residue"));
  return checkpoint;
}

}  // namespace

std::string checkpoint_text(const Checkpoint& checkpoint, const std::string& key, std::uint64_t number) {
  Json json{{"key", key},
            {"number", number},
            {"file", to_json(checkpoint.file)},
            {"checks", checkpoint.checks},
            {"trials", to_json(checkpoint.trials)},
            {"arm", to_json(checkpoint.arm)},
            {"refusals", to_json(checkpoint.refusals)},
            {"replayed", to_json(checkpoint.replayed)}};
  if (checkpoint.sweeping) json["sweeping"] = to_json(*checkpoint.sweeping);
  if (checkpoint.swept) json["swept"] = to_json(*checkpoint.swept);
  if (const auto& figures = checkpoint.sweep_figures)
    json["sweep_figures"] = {figures->cut, figures->left, figures->uncovered};
  if (checkpoint.milling) json["milling"] = milling_json(*checkpoint.milling);
  if (checkpoint.milled) json["milled"] = milled_json(*checkpoint.milled);
  if (checkpoint.residue) json["residue"] = to_json(*checkpoint.residue);
  const std::string body = json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
  return sha256_hex(body) + '\n' + body;
}

std::optional<NumberedCheckpoint> read_checkpoint(std::string_view text, const std::string& key) {
  if (text.size() <= hash_length || text[hash_length] != '\n') return std::nullopt;
  const std::string_view body = text.substr(hash_length + 1);
  if (sha256_hex(body) != text.substr(0, hash_length)) return std::nullopt;
  const Json json = Json::parse(body);  // as it was written: the hash says so
  if (json.at("key") != key) return std::nullopt;
  return NumberedCheckpoint{json.at("number").get<std::uint64_t>(), checkpoint_of(json)};
}

}  // namespace sculpt
