// An instance of the FMU: a scene, its insertion, and the variables of the model description.
//
// What both versions of FMI share. fmi2.cpp and fmi3.cpp only translate.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calls.hpp"
#include "punctura.h"

namespace punctura_fmi {

/// The value references. python/punctura/fmu/description.py has the same numbers.
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

/// The types of the variables.
enum class Kind { real, integer, boolean };

/// Everything that changes during a run, beside the parameters and the state of the insertion.
struct Run {
  std::array<double, 6> input{};       ///< position, m; axis
  std::array<double, 6> previous{};    ///< the inputs of the last step
  std::array<double, 6> derivative{};  ///< of the inputs, 1/s; used if given
  std::array<double, 3> force{};       ///< N
  double time = 0;                     ///< the end of the last step, s
  double stop = std::numeric_limits<double>::infinity();
  double elapsed = 0, rest = 0;  ///< the sum of all steps, s, and what is too small for it
  std::uint64_t ticks = 0;
  std::uint64_t scene = 0;   ///< the checksum of scene.txt
  std::int32_t ramp = 1;     ///< 1: inputs move in a straight line during a step; 0: they are held
  std::int32_t given = 0;    ///< whether derivatives were given since the last step
  std::int32_t stepped = 0;  ///< whether there was a step
  State state = State::instantiated;
};

/// A saved state.
struct Saved {
  Run run;
  std::vector<double> parameters;
  std::vector<unsigned char> insertion;  ///< empty before the end of the initialization

  /// With the checksum at the end.
  std::size_t size() const noexcept {
    return sizeof(Run) + parameters.size() * sizeof(double) + insertion.size() + sizeof(std::uint64_t);
  }
  void write(unsigned char* to) const noexcept;
};

class Instance {
 public:
  /// resources: the folder with scene.txt. Returns nullptr and fills `error` if the scene cannot be made.
  static std::unique_ptr<Instance> make(const std::string& resources, std::string& error);

  bool get(std::uint32_t reference, Kind kind, double& value);
  /// Whether set() may be called now. Reports what is wrong, and changes nothing.
  bool settable(std::uint32_t reference, Kind kind);
  void set(std::uint32_t reference, double value);
  /// Whether set_derivative() may be called. Reports what is wrong.
  bool derivable(std::uint32_t reference, int order, double value);
  void set_derivative(std::uint32_t reference, double value);

  /// stop: infinite if the simulator names none.
  bool set_times(double start, double stop);
  /// Makes the insertion with the parameters as they are now.
  bool begin();
  /// Makes all ticks from `time` to `time + duration`. A step that fails changes nothing.
  bool step(double time, double duration);
  bool reset();

  std::unique_ptr<Saved> save() const;
  bool restore(const Saved& saved);
  std::unique_ptr<Saved> read(const unsigned char* bytes, std::size_t size);

  double time() const noexcept { return run_.time; }
  State state() const noexcept { return run_.state; }
  void move_to(State state) noexcept { run_.state = state; }
  bool fail(std::string error);
  const std::string& error() const noexcept { return error_; }

 private:
  template <auto free>
  struct Free {
    void operator()(auto* handle) const noexcept { free(handle); }
  };
  using Scene = std::unique_ptr<punctura_scene, Free<punctura_scene_free>>;
  using Insertion = std::unique_ptr<punctura_insertion, Free<punctura_insertion_free>>;

  /// Whether there is a variable of this kind. Reports what is wrong.
  bool check(std::uint32_t reference, Kind kind);
  bool build(const punctura_scene* scene, Insertion& insertion);
  std::vector<unsigned char> bytes() const;
  bool count_ticks(double end, double duration, Run& after, std::uint64_t& count);
  bool tick(std::uint64_t i, std::uint64_t count, std::array<double, 3>& force);

  std::string text_;  ///< of scene.txt
  Scene scene_;
  Insertion insertion_;
  std::vector<std::string> parameters_;
  std::vector<double> values_;  ///< of the parameters
  double rate_ = 0;
  Run run_;
  std::string error_;
};

}  // namespace punctura_fmi
