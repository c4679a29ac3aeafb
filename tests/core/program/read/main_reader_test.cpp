#include "core/program/read/main_reader.hpp"

#include "tests/core/program/program_cases.hpp"

namespace sculpt {
namespace {

TEST(MainReader, TheMainProgramCallsEachPartAtItsNumberAndRemembersTheNext) {
  for (const Case& one : cases) {
    if (!facts_of(one.dialect).has_main) continue;
    SCOPED_TRACE(facts_of(one.dialect).name);
    const Cell cell = shipped_cell(one.cell);
    Random random(3);
    ProgramDemands demands = demands_of(one.dialect);
    demands.part_keyframes = 3;
    const Made made = make(path_of(cell, wander(cell, random, 40), 8), cell, demands);
    ASSERT_GT(made.report.parts, 3U);
    const std::string text = made.files.at("bust" + std::string(facts_of(one.dialect).extension)),
                      data = one.dialect == Dialect::krl ? made.files.at("bust.dat") : "";
    std::vector<std::string> names;
    for (std::size_t part = 1; part <= made.report.parts; ++part)
      names.push_back(ProgramNames{"bust", part, 0, {}}.part_name());
    EXPECT_EQ(read_main(one.dialect, text, data), names);
    // Without any one of its lines it is none, unless that is a comment.
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
      std::string damaged = text;
      const std::string line = damaged.substr(at, damaged.find('\n', at) + 1 - at);
      const bool means_nothing = line.find_first_not_of(" ") == line.find_first_of(";!") ||
                                 line.find(":  !") != std::string::npos || line.starts_with("/ATTR") ||
                                 line.starts_with("/MN") || line.starts_with("/PROG") || line.starts_with("/POS") ||
                                 line.find("COUNT") != std::string::npos || line.starts_with("COMMENT") ||
                                 line.starts_with("DEFAULT");
      if (means_nothing) continue;
      damaged.erase(at, line.size());
      EXPECT_THROW(read_main(one.dialect, damaged, data), InputError) << line;
    }
    if (one.dialect == Dialect::krl) {
      EXPECT_THROW(read_main(one.dialect, text, "&ACCESS RVP\r\n&REL 1\r\nDEFDAT bust\r\nENDDAT\r\n"), InputError)
          << "the number would not be kept";
    }
  }
}

}  // namespace
}  // namespace sculpt
