#include "proto/motion/program_spec.hpp"

namespace sculpt::proto {
namespace {

constexpr std::size_t max_word_bytes = 64;

}  // namespace

// Which words, names and numbers there are is the planner's to say (`dialect_unknown`, `name_invalid`, `part_invalid`).
ProgramSpec read_program(Fields fields) {
  ProgramSpec spec;
  spec.dialect = fields.text("dialect", max_word_bytes);
  if (fields.has("name")) spec.name = fields.text("name", max_word_bytes);
  if (fields.has("motion")) spec.motion = read_motion(fields.object("motion"));
  if (fields.has("part_keyframes")) spec.part_keyframes = fields.count("part_keyframes");
  if (fields.has("part_bytes")) spec.part_bytes = fields.count("part_bytes");
  if (fields.has("stock_files")) spec.stock_files = fields.flag("stock_files");
  if (fields.has("seams_in_stock")) spec.seams_in_stock = fields.flag("seams_in_stock");
  fields.done();
  return spec;
}

Json to_json(const ProgramSpec& spec) {
  Json json{{"dialect", spec.dialect}};
  if (spec.name != ProgramSpec{}.name) json["name"] = spec.name;
  if (Json motion = to_json(spec.motion); !motion.empty()) json["motion"] = std::move(motion);
  if (spec.part_keyframes) json["part_keyframes"] = *spec.part_keyframes;
  if (spec.part_bytes) json["part_bytes"] = *spec.part_bytes;
  if (spec.stock_files) json["stock_files"] = true;
  if (spec.seams_in_stock) json["seams_in_stock"] = true;
  return json;
}

}  // namespace sculpt::proto
