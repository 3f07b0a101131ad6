// Some ticks of one kind, for a program that counts instructions (benchmarks/instructions.py).
//
//   bench_instructions KIND TICKS
#include <cstdio>
#include <cstdlib>
#include <string>

#include "../work.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"

namespace {

using namespace punctura;

/// The depth of a tick: one insertion and withdrawal, with a tremor, again and again.
double depth_of(std::size_t k) noexcept {
  const double u = static_cast<double>(k % 4000) / 4000, s = 4 * u * (1 - u);
  return -2e-3 + 9e-3 * s + (k % 7 < 3 ? 2e-5 : -2e-5);
}

double on_a_line(Solver solver, std::size_t ticks) {
  Proxy1d<ThickLaw> proxy(ThickLaw({1.08e-3, 0.28}, {570, 0.41, 0.2, 1e-3}), Coupling{400, 1}, 1 / bench::rate, solver);
  double sum = 0;
  for (std::size_t k = 0; k < ticks; ++k) sum += proxy.step(depth_of(k));
  return sum;
}
double in_space(const Scene& scene, std::size_t ticks) {
  Insertion insertion = build_insertion(scene);
  double sum = 0;
  for (std::size_t k = 0; k < ticks; ++k) sum += insertion.step({0, -depth_of(k), 0}, {0, -1, 0}).y();
  return sum;
}
double servo_step(const Scene& scene, std::size_t ticks) {
  ServoStep servo = build(scene);
  servo.arm();
  double sum = 0;
  for (std::size_t k = 0; k < ticks; ++k) {
    DeviceSample sample{};
    sample.sequence = k;
    sample.healthy = true;
    sample.time = static_cast<double>(k) / bench::rate;
    sample.position = {0, -depth_of(k), 0};
    sample.axis = {0, -1, 0};
    sum += servo.step(sample).force[1];
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string kind = argv[1];
  const auto ticks = static_cast<std::size_t>(std::atol(argv[2]));
  const Solver solver = kind.find("paper") != std::string::npos ? Solver::paper : Solver::exact;
  Scene scene = bench::scene_of(kind.find("two membranes") != std::string::npos ? 2 : 1, solver);
  if (kind.find("line fit") != std::string::npos) {
    scene.servo.conditioning = Conditioning::line_fit;
    scene.servo.encoder_step = 5.5e-5;
  }
  if (kind.find("tissue") != std::string::npos) {
    scene.membranes[0].tissue.profile = {{0, -0.1, 0.05}, {1e-3, -0.3, 0.1}, {3e-3, -0.6, 0.25}, {4e-3, -0.4, 0.3}};
    scene.membranes[0].tissue.cutting = 0.3;
  }
  const double sum = kind.starts_with("1-D")   ? on_a_line(solver, ticks)
                     : kind.starts_with("3-D") ? in_space(scene, ticks)
                                               : servo_step(scene, ticks);
  std::printf("%s\n", BENCH_COMPILER);
  return std::isfinite(sum) ? 0 : 3;
}
