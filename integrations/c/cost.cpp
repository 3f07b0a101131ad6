// The time of a tick: in the core itself, and through the C library.   cost REFERENCE
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "punctura.h"
#include "punctura/scene/build.hpp"

namespace {

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Prints the shortest time of `ticks` ticks, per tick.
template <typename F>
void time(const char* name, std::size_t ticks, F&& run) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 100; ++i) {
    const auto start = std::chrono::steady_clock::now();
    run();
    best = std::min(best, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("%s\t%.1f\n", name, best / static_cast<double>(ticks));
}

/// K06 Fig. 12, as in integrations/reference.py.
punctura::Scene scene_of(const punctura_scene* given) {
  punctura::Scene scene;
  const auto get = [&](const std::string& path) {
    double value = 0;
    if (punctura_scene_get(given, path.c_str(), &value) != PUNCTURA_OK) std::abort();
    return value;
  };
  scene.needle = {get("needle.diameter"), get("needle.tip_angle")};
  scene.coupling = {get("coupling.stiffness"), get("coupling.damping")};
  for (int i = 0; i < punctura_scene_membrane_count(given); ++i) {
    const std::string m = "membrane[" + std::to_string(i) + "].";
    punctura::PlacedMembrane placed;
    placed.membrane = {get(m + "stiffness"), get(m + "precompression"), get(m + "friction"), get(m + "thickness")};
    for (std::size_t k = 0; k < 3; ++k) {
      placed.point[k] = get(m + "point[" + std::to_string(k) + "]");
      placed.inward_normal[k] = get(m + "inward_normal[" + std::to_string(k) + "]");
    }
    scene.membranes.push_back(placed);
  }
  return scene;
}

}  // namespace

int main(int, char** arguments) {
  const std::string folder = arguments[1], text = read(folder + "/scene.toml"), bytes = read(folder + "/motion.f64");
  std::vector<double> rows(bytes.size() / sizeof(double));
  std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(double));
  const std::size_t n = rows.size() / 9;
  punctura_scene* scene = nullptr;
  punctura_insertion* insertion = nullptr;
  punctura_servo* servo = nullptr;
  if (punctura_scene_from_toml(text.data(), text.size(), &scene) != PUNCTURA_OK ||
      punctura_insertion_new(scene, &insertion) != PUNCTURA_OK ||
      punctura_servo_new(scene, nullptr, &servo) != PUNCTURA_OK)
    return 1;

  auto core = punctura::build_insertion(scene_of(scene));
  double sum = 0;
  time("C++: the core, insertion", n, [&] {
    core.reset();
    for (std::size_t k = 0; k < n; ++k) {
      const double* r = &rows[9 * k];
      sum += core.step({r[0], r[1], r[2]}, punctura::Vector3d(r[3], r[4], r[5]).stableNormalized()).y();
    }
  });
  time("C: punctura_insertion_step", n, [&] {
    punctura_insertion_reset(insertion);
    double force[3];
    for (std::size_t k = 0; k < n; ++k) {
      punctura_insertion_step(insertion, &rows[9 * k], &rows[9 * k + 3], force);
      sum += force[1];
    }
  });
  time("C: punctura_insertion_peek and _commit", n, [&] {
    punctura_insertion_reset(insertion);
    double force[3];
    for (std::size_t k = 0; k < n; ++k) {
      punctura_insertion_peek(insertion, &rows[9 * k], &rows[9 * k + 3], force);
      punctura_insertion_commit(insertion);
      sum += force[1];
    }
  });
  punctura_sample sample;
  punctura_sample_init(&sample, sizeof sample);
  punctura_record record;
  record.struct_size = sizeof record;
  time("C: punctura_servo_step", n, [&] {
    punctura_servo_reset(servo);
    for (std::size_t k = 0; k < n; ++k) {
      sample.sequence = k;
      sample.time = static_cast<double>(k) / 1600;
      std::memcpy(sample.position, &rows[9 * k], 3 * sizeof(double));
      std::memcpy(sample.axis, &rows[9 * k + 3], 3 * sizeof(double));
      punctura_servo_step(servo, &sample, &record);
      sum += record.model_force[1];
    }
  });
  return sum == 0;  // all ticks were needed
}
