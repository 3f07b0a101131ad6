// A law from a table.
#include "punctura/model/table_law.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "punctura/proxy/proxy_1d.hpp"

using namespace punctura;

namespace {

constexpr double T = 1 / 1600.0;
std::vector<Problem> problems_of(std::vector<double> depth, std::vector<double> lower, std::vector<double> upper) {
  std::vector<Problem> problems;
  check_table(depth, lower, upper, problems);
  return problems;
}

}  // namespace

TEST_CASE("a table's band has straight lines between its knots, nothing before and constant edges behind") {
  const double depth[] = {1e-3, 3e-3, 4e-3}, lower[] = {-0.1, -0.5, -0.2}, upper[] = {0.2, 0.3, 0.25};
  const TableLaw law(depth, lower, upper);
  CHECK(law.band(0.999e-3).lower == 0);
  CHECK(law.band(1e-3).lower == -0.1);
  CHECK(law.band(2e-3).lower == doctest::Approx(-0.3));
  CHECK(law.band(2e-3).upper == doctest::Approx(0.25));
  CHECK(law.band(3.5e-3).lower == doctest::Approx(-0.35));
  CHECK(law.band(1).lower == -0.2);
  CHECK(law.band(1).upper == 0.25);
}

TEST_CASE("a proxy on a table slides on its edges and sticks between them") {
  const double depth[] = {0, 30e-3}, lower[] = {0, -1.5}, upper[] = {0, 1.5};
  for (const Solver solver : {Solver::exact, Solver::paper}) {
    Proxy1d<TableLaw> proxy(TableLaw(depth, lower, upper), Coupling{400, 1}, T, solver);
    for (int k = 0; k <= 1600; ++k) {
      const double p = 20e-3 * (k < 800 ? k : 1600 - k) / 800;
      const double force = proxy.step(p), edge = 50 * proxy.depth();
      if (proxy.phase() == Phase::sliding_in) CHECK(force == doctest::Approx(-edge));
      if (proxy.phase() == Phase::sliding_out) CHECK(force == doctest::Approx(edge));
    }
    CHECK(proxy.phase() == Phase::sliding_out);
  }
}

TEST_CASE("a table with 32 knots works, and everything that is no table is told") {
  std::vector<double> depth, lower, upper;
  for (std::size_t i = 0; i < max_knots; ++i) {
    depth.push_back(1e-3 * static_cast<double>(i));
    lower.push_back(-0.01 * static_cast<double>(i));
    upper.push_back(0.01 * static_cast<double>(i));
  }
  CHECK(problems_of(depth, lower, upper).empty());
  CHECK(TableLaw(depth, lower, upper).band(30.5e-3).upper == doctest::Approx(0.305));
  depth.push_back(1), lower.push_back(0), upper.push_back(0);
  CHECK(problems_of(depth, lower, upper).at(0).reason == "must have 1 to 32 knots");
  CHECK(problems_of({}, {}, {}).size() == 1);
  CHECK(problems_of({0, 1}, {0}, {0, 0}).at(0).path == "lower");
  CHECK(problems_of({-1}, {0}, {0}).at(0).path == "depth[0]");
  CHECK(problems_of({0, 0}, {0, 0}, {0, 0}).at(0).path == "depth[1]");
  CHECK(problems_of({0}, {0}, {-0.5}).at(0).reason == "must not be greater than upper at the same knot");
  CHECK(problems_of({0}, {1}, {1.5}).at(0).reason == "must be 0 N or less: the lower edge resists insertion");
  CHECK(problems_of({0, 1}, {0, 0}, {0}).at(0).path == "upper");
  CHECK(problems_of({0}, {0}, {std::numeric_limits<double>::infinity()}).at(0).path == "upper[0]");
}
