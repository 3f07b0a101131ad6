// Decimal numbers in both ways, with std::from_chars and with the functions of C, in every locale.
#include "punctura/model/decimal.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <string>

#include "support/comma_locale.hpp"

namespace {
using punctura::decimal_text;
using punctura::read_decimal;
using punctura::scaled_decimal;
}  // namespace

TEST_CASE("decimal numbers: exact in both ways, also where the program's locale has a decimal comma") {
  const punctura::test::CommaLocale comma;
#ifndef _WIN32
  REQUIRE(comma.works());
#endif
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    const std::string text = decimal_text(number);
    REQUIRE(text.find(',') == std::string::npos);
    REQUIRE(read_decimal(text) == number);
  }
  CHECK(decimal_text(-1e-7) == "-1e-07");
  CHECK(decimal_text(0.57) == "0.57");
  CHECK(decimal_text(2.0 / 3, 4) == "0.6667");
  CHECK(read_decimal("0.1e-2") == 0.001);
  CHECK(read_decimal("4.9e-324") == 5e-324);
  CHECK(read_decimal("-0.0e9") == 0);
  for (const char* wrong : {"", "0,5", " 1", "+1", "0x1", "1e", "1 ", "1e400", "1e-400", "inf", "nan"})
    CHECK(!read_decimal(wrong));
}

TEST_CASE("decimal numbers: a number in another unit is rounded once") {
  CHECK(scaled_decimal("1.08", "1", -3) == 0.00108);
  CHECK(scaled_decimal("-2.1855455533155981734e+0", "1", -3) == -0.0021855455533155983);  // twice: ...598
  CHECK(scaled_decimal("0.00000012", "25", 9) == 3000);
  CHECK(scaled_decimal("1e308", "1", 3) == std::numeric_limits<double>::infinity());
  CHECK(scaled_decimal("-1e-999999999999999999999", "1", 3) == 0);
  CHECK(scaled_decimal("0e999999999999999999999", "1", 3) == 0);
  CHECK(std::signbit(scaled_decimal("-0.0", "1", -3)));
}

TEST_CASE("a number of any length is the nearest double: no digit is too far behind to decide") {
  const std::string zeros(1500, '0');
  CHECK(scaled_decimal("0.5" + zeros, "1", -3) == 0.0005);
  CHECK(scaled_decimal("1" + zeros + "e-1500", "1", 0) == 1);
  CHECK(scaled_decimal("-0." + zeros + "25e1500", "1", 0) == -0.25);
  const std::string half = "9007199254740993";  // between two doubles
  CHECK(scaled_decimal(half + "." + zeros, "1", 0) == 9007199254740992.0);
  CHECK(scaled_decimal(half + "." + zeros + "1", "1", 0) == 9007199254740994.0);
}
