// The effect of encoder noise on the force, with and without conditioning: the values in docs/conditioning.md.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "../support/encoder.hpp"
#include "../support/paper_scene.hpp"
#include "../support/tick.hpp"
#include "punctura/lab/plant/experiment.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double allowed = 0.016;  // N rms from tick to tick

Scene scene_with(Conditioning how, Solver solver, double low_pass = 300, double thickness = 1e-3) {
  Scene scene = paper_scene(thickness, solver);
  scene.servo.conditioning = how;
  scene.servo.low_pass = low_pass;
  scene.servo.encoder_step = count;
  return scene;
}

/// The rms of f(k) - f(k-1) along each axis, N. The needle goes in to 12 mm and back by 1 mm, so that it sticks. Then
/// the given axes dither for 2 s. The first 0.5 s do not count.
Vector3d rest_noise(const Scene& scene, Dither kind, std::array<bool, 3> axes = {false, true, false}) {
  Insertion insertion = build_insertion(scene);
  Noise noise(3);
  double y = 2e-3;
  for (; y > -12e-3; y -= 20e-3 * T) insertion.step({0, encoder(y), 0}, down);
  for (; y < -11e-3; y += 5e-3 * T) insertion.step({0, encoder(y), 0}, down);
  const Vector3d rest(0, encoder(y), 0);
  for (int k = 0; k < 400; ++k) insertion.step(rest, down);

  Vector3d previous = insertion.force(), square = Vector3d::Zero();
  for (int k = 0; k < 3200; ++k) {
    Vector3d p = rest;
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = dither(kind, k, noise);
      if (axes[i]) p[i] += d;
    }
    const Vector3d now = insertion.step(p, down);
    CHECK((*insertion.k06())[0].phase() == Phase::sticking);
    if (k >= 800)
      for (std::size_t i = 0; i < 3; ++i) square[i] += (now[i] - previous[i]) * (now[i] - previous[i]) / 2400;
    previous = now;
  }
  return {std::sqrt(square[0]), std::sqrt(square[1]), std::sqrt(square[2])};
}

/// The drop of the force at the pop of K06's 0.1 mm membrane, N: the largest force minus the mean of the plateau.
double pop(const Scene& scene, double speed, bool ideal, double phase = 0) {
  Insertion insertion = build_insertion(scene);
  double greatest = 0, plateau = 0;
  int n = 0;
  for (double y = 1e-3; y > -9e-3; y -= speed * T) {
    const double f = insertion.step({0, ideal ? y : encoder(y, phase), 0}, down)[1];
    greatest = std::max(greatest, f);
    if (y > -7e-3) continue;
    plateau += f;
    ++n;
  }
  return greatest - plateau / n;
}

}  // namespace

TEST_CASE("a dither of one count changes the force by 0.20 N rms, behind K06's filter by 0.114 N rms") {
  for (const Solver solver : {Solver::exact, Solver::paper}) {
    CHECK(rest_noise(scene_with(Conditioning::low_pass, solver, 0), Dither::three)[1] ==
          doctest::Approx(0.20).epsilon(0.02));
    CHECK(rest_noise(scene_with(Conditioning::low_pass, solver), Dither::three)[1] ==
          doctest::Approx(0.114).epsilon(0.02));
    // The expected value for `toggle`: a count changes f* by g, and the next count changes it back by g - K, with
    // g = K + B/T. The gain of the filter at half the rate is a / (2 - a).
    const double plain = (2 * 2000 - 400) * count, a = 0.6921;
    CHECK(rest_noise(scene_with(Conditioning::low_pass, solver, 0), Dither::toggle)[1] ==
          doctest::Approx(plain).epsilon(1e-3));
    CHECK(rest_noise(scene_with(Conditioning::low_pass, solver), Dither::toggle)[1] ==
          doctest::Approx(plain * a / (2 - a)).epsilon(1e-3));
  }
}

TEST_CASE("at rest, the line fit leaves at most 0.016 N rms from tick to tick for every dither" *
          doctest::test_suite("numbers")) {
  for (const Solver solver : {Solver::exact, Solver::paper})
    for (const Dither kind : all_dithers) {
      const Scene scene = scene_with(Conditioning::line_fit, solver);
      CAPTURE(static_cast<int>(kind));
      CHECK(rest_noise(scene, kind)[1] <= allowed);
      CHECK(rest_noise(scene, kind, {true, false, false})[0] <= allowed);
      CHECK(rest_noise(scene, kind, {true, true, true}).maxAbs() <= allowed);
    }
}

TEST_CASE("where three or five membranes hold the needle, the line fit leaves at most 0.016 N rms, too" *
          doctest::test_suite("numbers")) {
  // The coupling of the ready scene venipuncture, and a stiffer one. While all membranes stick, their forces are equal.
  struct Hold {
    Coupling coupling;
    int membranes;
  };
  for (const auto& [coupling, membranes] : {Hold{{500, 0.5}, 3}, Hold{{600, 0.3}, 5}})
    for (const Dither kind : all_dithers) {
      Scene scene = scene_with(Conditioning::line_fit, Solver::exact);
      scene.coupling = coupling;
      for (int i = 1; i < membranes; ++i) {
        scene.membranes.push_back(scene.membranes[0]);
        scene.membranes.back().point[1] = -1e-3 * i;
      }
      CHECK(rest_noise(scene, kind)[1] <= allowed);
    }
}

TEST_CASE("a slow slide behind the line fit has at most 5 mN of ripple from 0.3 to 5 mm/s, and 12 mN below") {
  for (const double speed : {0.1e-3, 0.3e-3, 1e-3, 2e-3, 5e-3}) {
    Insertion insertion = build_insertion(scene_with(Conditioning::line_fit, Solver::exact));
    double y = 1e-3, least = 1e9, most = 0;
    for (; y > -7e-3; y -= 20e-3 * T) insertion.step({0, encoder(y, 0.3), 0}, down);  // only the shaft is left inside
    for (int k = 0; k < 9600; ++k, y -= speed * T) {
      const double f = insertion.step({0, encoder(y, 0.3), 0}, down)[1];
      if (k < 400) continue;
      least = std::min(least, f);
      most = std::max(most, f);
    }
    CHECK(most - least < (speed < 0.3e-3 ? 0.012 : 0.005));
  }
}

TEST_CASE("the line fit changes the pop by at most 2 %, at every speed and encoder phase" *
          doctest::test_suite("numbers")) {
  for (const Solver solver : {Solver::exact, Solver::paper})
    for (const double speed : {5e-3, 10e-3, 20e-3}) {
      const double right = pop(scene_with(Conditioning::low_pass, solver, 300, 1e-4), speed, true);
      for (int phase = 0; phase < 8; ++phase)
        CHECK(pop(scene_with(Conditioning::line_fit, solver, 300, 1e-4), speed, false, phase / 8.0) ==
              doctest::Approx(right).epsilon(0.02));
    }
}

TEST_CASE("with the line fit, a slow stroke gives a smooth force without steps at the counts") {
  for (const double speed : {0.2e-3, 1e-3, 3e-3}) {
    Scene scene = scene_with(Conditioning::line_fit, Solver::exact);
    Insertion noisy = build_insertion(scene);
    Insertion right = build_insertion(scene_with(Conditioning::low_pass, Solver::exact));
    double y = 2e-3;
    for (; y > -12e-3; y -= 20e-3 * T) noisy.step({0, encoder(y, 0.3), 0}, down), right.step({0, y, 0}, down);
    double before = noisy.force()[1], square = 0;
    const double start = y;
    int n = 0;
    for (; y < start + 0.8e-3; y += speed * T) {  // the proxy sticks during the whole stroke
      const double f = noisy.step({0, encoder(y, 0.3), 0}, down)[1], f_right = right.step({0, y, 0}, down)[1];
      if (++n > 48) {
        square += (f - before) * (f - before);
        CHECK(std::abs(f - f_right) < 400 * count + 0.03);
      }
      before = f;
    }
    CHECK(std::sqrt(square / (n - 48)) < allowed / 2);
  }
}

TEST_CASE("a simulated Omni in a resting hand neither buzzes nor creeps in tissue") {
  for (const Solver solver : {Solver::exact, Solver::paper})
    for (const bool friction : {true, false}) {
      DeviceDynamics omni;
      if (!friction) omni.friction = 0;  // only the hand damps this device, and its tremor crosses counts
      const RecordedMotion motion({0, 1, 2, 2.3, 6},
                                  {{0, 3e-3, 0}, {0, 3e-3, 0}, {0, -12e-3, 0}, {0, -11.5e-3, 0}, {0, -11.5e-3, 0}});
      Experiment experiment(scene_with(Conditioning::line_fit, solver), motion, down, omni, Hand{}, 5);
      Vector3d previous = Vector3d::Zero(), begin = Vector3d::Zero(), mean = Vector3d::Zero();
      double square = 0;
      for (int k = 0; k < 11200; ++k) {
        const Snapshot& s = experiment.step();
        const Vector3d force = to_vector(s.force);
        if (k >= 4800) {
          square += (force - previous).squaredNorm() / 6400;
          (k < 8000 ? begin : mean) += experiment.tip() / 3200;
        }
        previous = force;
      }
      CHECK(experiment.servo().fault() == Fault::none);
      CHECK(previous.norm() > 0.05);  // the tissue holds the needle
      CHECK(std::sqrt(square) < (friction ? 1e-9 : allowed / 2));
      CHECK((mean - begin).norm() < (friction ? 1e-9 : 2e-5));
    }
}
