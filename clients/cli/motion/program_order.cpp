#include "clients/cli/motion/program_order.hpp"

#include "clients/cli/exit_code.hpp"

namespace sculpt::cli {

void add_program_options(CLI::App& command, ProgramOrder& order) {
  command
      .add_option("--dialect", order.dialect,
                  "Of a program: the language of KUKA, ABB, Universal Robots, FANUC, LinuxCNC, ROS 2")
      ->check(CLI::IsMember({"krl", "rapid", "urscript", "fanuc", "gcode", "ros2"}));
  command.add_option("--name", order.name, "Of a program: what it is called; without it sculpt")->type_name("NAME");
  command.add_option("--feed", order.feed_m_s, "Of a program: speed of the ball while it cuts")->type_name("M_S");
  command.add_option("--rapid", order.rapid_m_s, "Of a program: speed of the ball on moves; 0.5")->type_name("M_S");
  command.add_option("--keep-feed", order.keep_feed, "Of a program: as of time")->type_name("SHARE");
  command.add_option("--part-keyframes", order.part_keyframes, "Of a program: keyframes in a part at most")
      ->type_name("M");
  command.add_option("--part-bytes", order.part_bytes, "Of a program: bytes of a part at most")->type_name("B");
  command.add_flag("--stock-files", order.stock_files,
                   "Of a program: with each part what stands when it begins (.binvox)");
  command.add_flag("--seams-in-stock", order.seams_in_stock,
                   "Of a program: let parts begin and end with the tool in the material");
}

Json program_field(const ProgramOrder& order, const std::string& artifact) {
  if (artifact != "program") {
    if (!order.dialect.empty()) throw Failure(exit_usage, "usage", "--dialect is for --artifact program: add that");
    return nullptr;
  }
  if (order.dialect.empty())
    throw Failure(exit_usage, "usage", "--dialect is required: say for which controller the program is, as krl");
  Json motion = Json::object(), program{{"dialect", order.dialect}};
  if (order.feed_m_s) motion["feed_m_s"] = *order.feed_m_s;
  if (order.rapid_m_s) motion["rapid_m_s"] = *order.rapid_m_s;
  if (order.keep_feed) motion["keep_feed"] = *order.keep_feed;
  program["motion"] = std::move(motion);
  if (order.name) program["name"] = *order.name;
  if (order.part_keyframes) program["part_keyframes"] = *order.part_keyframes;
  if (order.part_bytes) program["part_bytes"] = *order.part_bytes;
  if (order.stock_files) program["stock_files"] = true;
  if (order.seams_in_stock) program["seams_in_stock"] = true;
  return program;
}

}  // namespace sculpt::cli
