// An instance of the FMU: a scene, its insertion, and the variables of the model description.
//
// What both versions of FMI share. fmi2.cpp and fmi3.cpp only translate.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "punctura.h"

namespace punctura_fmi {

/// The value references. python/punctura/fmu/variables.py has the same numbers.
enum Reference : std::uint32_t {
  time_reference = 0,
  input_reference = 1,   ///< 1 to 6: position, axis
  output_reference = 7,  ///< 7 to 9: force
  ramp_reference = 10,
  membrane_reference = 100,    ///< 100 + 4 i: depth, axial force, phase of membrane i
  parameter_reference = 1000,  ///< 1000 + k: number k of scene.txt
};

/// Of one step: about a minute of computing. A wrong unit of time must not hang the simulator.
inline constexpr std::uint64_t most_ticks = 1'000'000'000;

/// Everything that changes during a run, beside the state of the insertion.
struct Run {
  std::array<double, 6> input{};       ///< position, m; axis
  std::array<double, 6> previous{};    ///< the inputs of the last step
  std::array<double, 6> derivative{};  ///< of the inputs, 1/s; used if given
  std::array<double, 3> force{};       ///< N
  double start = 0, time = 0;          ///< s
  std::uint64_t ticks = 0;
  std::int32_t ramp = 1;     ///< 1: inputs move in a straight line during a step; 0: they are held
  std::int32_t given = 0;    ///< whether derivatives were given since the last step
  std::int32_t stepped = 0;  ///< whether there was a step
};

/// A saved state.
struct Saved {
  Run run;
  std::vector<unsigned char> insertion;  ///< empty before the end of the initialization

  /// With the checksum at the end.
  std::size_t size() const noexcept { return sizeof(Run) + insertion.size() + sizeof(std::uint64_t); }
  void write(unsigned char* to) const noexcept;
};

class Instance {
 public:
  /// resources: the folder with scene.txt. Returns nullptr and fills `error` if the scene cannot be made.
  static std::unique_ptr<Instance> make(const std::string& resources, std::string& error);

  bool get(std::uint32_t reference, double& value) const;
  bool get(std::uint32_t reference, std::int32_t& value) const;
  bool set(std::uint32_t reference, double value);
  bool set(std::uint32_t reference, std::int32_t value);
  bool set_derivative(std::uint32_t reference, double value);

  void start_at(double time) noexcept { run_.start = run_.time = time; }
  /// Makes the insertion with the parameters as they are now.
  bool begin();
  /// Makes all ticks from `time` to `time + duration`.
  bool step(double time, double duration);
  bool reset();

  std::unique_ptr<Saved> save();
  bool restore(const Saved& saved);
  std::unique_ptr<Saved> read(const unsigned char* bytes, std::size_t size);

  double time() const noexcept { return run_.time; }
  const std::string& error() const noexcept { return error_; }

 private:
  template <auto free>
  struct Free {
    void operator()(auto* handle) const noexcept { free(handle); }
  };
  bool fail(std::string error);
  bool tick(std::uint64_t i, std::uint64_t count);

  std::string text_;  ///< of scene.txt
  std::unique_ptr<punctura_scene, Free<punctura_scene_free>> scene_;
  std::unique_ptr<punctura_insertion, Free<punctura_insertion_free>> insertion_;
  std::vector<std::string> parameters_;
  double rate_ = 0;
  Run run_;
  std::string error_;
};

}  // namespace punctura_fmi
