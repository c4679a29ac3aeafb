#include "core/trajectory/text/number_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/base/random.hpp"
#include "core/trajectory/quantum.hpp"

namespace sculpt {
namespace {

std::string written(double value) {
  std::array<char, max_number_bytes> out;
  return {out.data(), write_number(out.data(), value)};
}

std::string shortest(double value) {
  std::array<char, 64> out;
  return {out.data(), std::to_chars(out.data(), out.data() + out.size(), value).ptr};
}

void expect_shortest(double value) {
  EXPECT_EQ(written(value), shortest(value + 0.0));
}

TEST(NumberText, IsTheShortestFormOfEveryMultipleOfTheQuantum) {
  for (std::int64_t quanta = 0; quanta < 1'100'000; ++quanta) expect_shortest(from_quanta(quanta));
  for (std::int64_t size = 1; size <= max_quanta; size *= 10)
    for (std::int64_t factor = 1; factor < 100 && factor * size <= max_quanta; ++factor)
      for (std::int64_t aside : {-1, 0, 1}) {
        expect_shortest(from_quanta(factor * size + aside));
        expect_shortest(-from_quanta(factor * size + aside));
      }
  Random random(1);
  for (int n = 0; n < 500'000; ++n) {
    SCOPED_TRACE(n);
    const auto quanta = static_cast<std::int64_t>(random.next() >> (14 + random.next() % 50)) % max_quanta;
    expect_shortest(from_quanta(random.next() % 2 == 0 ? quanta : -quanta));
  }
}

TEST(NumberText, IsTheShortestFormOfAnyOtherNumberToo) {
  Random random(2);
  for (int n = 0; n < 100'000; ++n) {
    const auto value = std::bit_cast<double>(random.next());
    if (std::isfinite(value)) expect_shortest(value);
    expect_shortest(random.between(-7, 7));
  }
  for (double value : {1e-300, 1.7976931348623157e308, -2.2250738585072014e-308, 5e-324, 1.0 / 3, 1e8, 100000.1, -0.0})
    expect_shortest(value);
}

TEST(NumberText, RefusesWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (double value : {infinity, -infinity, std::nan("")}) EXPECT_THROW(written(value), std::invalid_argument);
}

TEST(Quantum, ComesBackFromEveryMultiple) {
  Random random(3);
  for (int n = 0; n < 1'000'000; ++n) {
    const auto quanta = static_cast<std::int64_t>(random.next() >> (14 + random.next() % 50)) % (max_quanta + 1);
    ASSERT_EQ(to_quanta(from_quanta(quanta)), quanta);
    ASSERT_EQ(to_quanta(-from_quanta(quanta)), -quanta);
  }
}

TEST(Quantum, NoOtherValueIsTakenForAMultiple) {
  for (double value : {1e-8, 0.5e-7, 1.5e-7, 3.14159265, 1e-9, 1.00000000000001e8, 1e300, -1e300})
    EXPECT_FALSE(to_quanta(value)) << value;
  EXPECT_FALSE(to_quanta(std::nan("")));
  EXPECT_FALSE(to_quanta(std::numeric_limits<double>::infinity()));
  for (double multiple : {1e-7, 0.5, 3.1415926, -2.8973, 1e8}) {
    EXPECT_TRUE(to_quanta(multiple)) << multiple;
    EXPECT_FALSE(to_quanta(std::nextafter(multiple, 1e9))) << multiple;
  }
}

}  // namespace
}  // namespace sculpt
