#include "core/plan/output/stock_files.hpp"

#include <algorithm>
#include <string_view>

#include "core/material/binvox.hpp"
#include "core/plan/intake.hpp"
#include "core/trajectory/milling/milled_stock.hpp"
#include "core/trajectory/reader.hpp"

namespace sculpt {
namespace {

/// A tool's name as all systems take it in a file's.
std::string file_part(std::string name) {
  constexpr std::string_view fine = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.-";
  std::ranges::replace_if(
      name, [&](char letter) { return fine.find(letter) == fine.npos; }, '_');
  return name;
}

}  // namespace

void give_stocks(const Job& job, std::istream& plan,
                 const std::function<void(const std::string& name, const std::string& binvox)>& give,
                 const Watch& watch) {
  TrajectoryReader reader(plan);
  const TrajectoryHeader& header = reader.header();
  if (!header.mill)
    throw InputError("trajectory_invalid", "the trajectory has no milling tools: its stock is that of the end");
  MilledStock stock(header, make_voxels(job, header.grid, watch).stock);
  std::size_t tool = 0, number = 0;
  const auto finish = [&] {
    give(std::to_string(++number) + "-" + file_part(header.mill->tools[tool].name) + ".binvox",
         write_binvox(stock.standing(), header.grid));
  };
  while (const auto keyframe = reader.next()) {
    if (keyframe->mill->is_change()) {
      finish();
      tool = static_cast<std::size_t>(keyframe->mill->tool);
    }
    stock.take(*keyframe->mill, keyframe->cut);
    if (watch.stop.stop_requested()) throw Cancelled{};
  }
  finish();
}

}  // namespace sculpt
