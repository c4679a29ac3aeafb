#include "core/program/part_size.hpp"

#include "tests/core/program/program_cases.hpp"

namespace sculpt {
namespace {

TEST(PartSize, PartsHaveNoMoreBytesThanIsSaidAndNotMuchFewer) {
  for (const Case& one : cases) {
    SCOPED_TRACE(facts_of(one.dialect).name);
    const Cell cell = shipped_cell(one.cell);
    Random random(11);
    const PlanPath path = path_of(cell, wander(cell, random, 400), 8);
    for (const std::uint64_t most : {3000u, 6000u, 20000u, 10'000'000u}) {
      ProgramDemands demands = demands_of(one.dialect);
      demands.part_bytes = most;
      const Made made = make(path, cell, demands);
      std::vector<std::uint64_t> bytes(made.report.parts + 1);
      for (const auto& [name, text] : made.files)
        if (name.starts_with("bust_")) bytes[std::stoul(name.substr(5))] += text.size();
      for (std::size_t part = 1; part < bytes.size(); ++part) {
        EXPECT_LE(bytes[part], most);
        const bool is_last = part + 1 == bytes.size();
        EXPECT_TRUE(is_last || bytes[part] * 2 >= most) << bytes[part] << " of " << most;
      }
      std::size_t moves = 0;
      for (const ReadPart& part : read_parts(one, made)) moves += part.moves.size();
      EXPECT_EQ(moves + 1, path.size());
    }
    ProgramDemands demands = demands_of(one.dialect);
    demands.part_bytes = 6000;
    demands.part_keyframes = 3;
    EXPECT_EQ(make(path, cell, demands).report.parts, (path.size() - 1 + 2) / 3) << "both limits hold";
    demands.part_bytes = 200;
    EXPECT_NE(refusal(path, cell, demands).find("--part-bytes"), std::string::npos) << refusal(path, cell, demands);
  }
}

}  // namespace
}  // namespace sculpt
