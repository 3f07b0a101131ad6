#include "punctura_runtime/backends/haply/decimal.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

using punctura::haply::decimal;

TEST_CASE("a numeral that is too great for a double is none, however it is written") {
  for (const char* text :
       {"1e400", "0.5e400", "0.5E+400", "-0.25e999", "1e99999999999999999999", "0.001e320", "-1e309", "12345e305"})
    CHECK_FALSE(decimal(text).has_value());
  CHECK_FALSE(decimal(std::string(400, '9')).has_value());
  CHECK_FALSE(decimal("0." + std::string(20, '0') + "1e400").has_value());
}

TEST_CASE("a numeral that is too small for a double is 0") {
  for (const char* text : {"1e-400", "0.5e-400", "-5e-999", "1e-99999999999999999999", "123456e-400"})
    CHECK(decimal(text) == 0.0);
  CHECK(decimal("0." + std::string(400, '0') + "1") == 0.0);
  CHECK(decimal("1" + std::string(20, '0') + "e-400") == 0.0);
}

TEST_CASE("a numeral within the range is the double next to it") {
  CHECK(decimal("0.1") == 0.1);
  CHECK(decimal("-12.5e-3") == -0.0125);
  CHECK(decimal("1.7976931348623157e308") == std::numeric_limits<double>::max());
  CHECK(decimal("0.00017976931348623157e312") == std::numeric_limits<double>::max());
  CHECK_FALSE(decimal("1x").has_value());
}
