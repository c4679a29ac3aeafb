#include "core/program/read/part_reader.hpp"

#include "tests/core/program/program_cases.hpp"

namespace sculpt {
namespace {

TEST(PartReader, ATextThatIsCutShortOrDamagedIsNotReadAsAWholeOne) {
  for (const Case& one : cases) {
    SCOPED_TRACE(facts_of(one.dialect).name);
    const Cell cell = shipped_cell(one.cell);
    Random random(3);
    const PlanPath path = path_of(cell, wander(cell, random, 12), 8);
    const Made made = make(path, cell, demands_of(one.dialect));
    const std::string text = made.files.at("bust_0001" + std::string(facts_of(one.dialect).extension));
    const std::size_t moves = read_part(one.dialect, text, one.letters).moves.size();
    // Behind the last word of a part a script calls it: what is before that may not be missing.
    const std::size_t whole = one.dialect == Dialect::urscript ? text.rfind("end\n") + 4 : text.size();
    for (std::size_t size = 0; size < whole; ++size) {
      const std::string cut = text.substr(0, size);
      try {
        const ReadPart read = read_part(one.dialect, cut, one.letters);
        EXPECT_LT(read.moves.size(), moves) << size;
      } catch (const InputError& error) {
        EXPECT_EQ(error.code(), "program_damaged");
      }
    }
    for (const char* wrong : {"nan", "1e5", "-0.0", "x"}) {
      std::string damaged = text;
      const std::size_t at = damaged.find(one.dialect == Dialect::krl        ? "PTP {A1 "
                                          : one.dialect == Dialect::rapid    ? "MoveAbsJ [["
                                          : one.dialect == Dialect::urscript ? "movej(["
                                          : one.dialect == Dialect::fanuc    ? "J1= "
                                                                             : "G1 X");
      ASSERT_NE(at, std::string::npos);
      const std::size_t number = damaged.find_first_of("-0123456789", damaged.find_first_of(" [=X", at + 4)),
                        end = damaged.find_first_not_of("-0123456789.", number);
      damaged.replace(number, end - number, wrong);
      EXPECT_THROW(read_part(one.dialect, damaged, one.letters), InputError) << wrong;
    }
  }
}

TEST(PartReader, APartThatWouldGoOnWhereItMustStopIsNotReadAsOne) {
  const std::map<Dialect, std::vector<std::pair<std::string, std::string>>> damages{
      {Dialect::krl, {{"  HALT\r\n", ""}, {">0.01 THEN", ">1.01 THEN"}}},
      {Dialect::rapid, {{"      Stop;\r\n", ""}, {">0.01 THEN", ">1.01 THEN"}}},
      {Dialect::urscript, {{"    halt\n", ""}, {"> 0.00018", "> 0.18"}}},
      {Dialect::fanuc, {{"  ABORT ;", "  END ;"}, {"R[90]>.01", "R[90]>9.01"}}},
      {Dialect::gcode, {{"  (ABORT, not", "  (not"}, {"GT 0.01", "GT 9.01"}}}};
  for (const Case& one : cases) {
    SCOPED_TRACE(facts_of(one.dialect).name);
    const Cell cell = shipped_cell(one.cell);
    Random random(3);
    const Made made = make(path_of(cell, wander(cell, random, 12), 8), cell, demands_of(one.dialect));
    const std::string text = made.files.at("bust_0001" + std::string(facts_of(one.dialect).extension));
    for (const auto& [good, bad] : damages.at(one.dialect)) {
      std::string damaged = text;
      const std::size_t at = damaged.find(good);
      ASSERT_NE(at, std::string::npos) << good;
      damaged.replace(at, good.size(), bad);
      EXPECT_THROW(read_part(one.dialect, damaged, one.letters), InputError) << good;
    }
  }
}

}  // namespace
}  // namespace sculpt
