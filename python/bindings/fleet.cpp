// Many experiments that a program steers at once, in lanes and on threads: the engine of the Gymnasium environments.
#include <nanobind/stl/optional.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "bindings.hpp"
#include "punctura_runtime/batch/fleet.hpp"
#include "simd_code.hpp"
#include "state.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

using batch::TrialRecord;

constexpr std::size_t ticks_without_signals = 100'000;  // of all trials: 0.1 s or less

/// The constructor's arguments, as they were given.
struct FleetArguments {
  Triple axis;
  DeviceDynamics plant;
  Hand hand;
  nb::object threads;
  std::optional<std::string> instructions;
};

class Fleet : public OneThread {
 public:
  explicit Fleet(const FleetArguments& given)
      : given_(given),
        fleet_({given.plant, given.hand, unit(given.axis, "axis"), &code_named(given.instructions)},
               threads_from(given.threads)) {}

  std::size_t size() const noexcept { return fleet_.size(); }
  std::size_t threads() const noexcept { return fleet_.threads(); }

  /// Makes trial i of a scene that is checked here. i may be size(): then the fleet grows by one.
  void place(std::size_t i, const Scene& scene, const Triple& start, std::uint64_t seed) {
    must_rest();
    if (i > size())
      throw nb::index_error(("the fleet has " + std::to_string(size()) + " trials; the next new one is trial " +
                             std::to_string(size()) + ", not " + std::to_string(i))
                                .c_str());
    raise_if(check(scene));
    if (!is_place(to_vector(start))) throw nb::value_error("start must be a position within 1000 km");
    fleet_.place(i, scene, to_vector(start), seed);
  }

  Object<"FleetStep"> step(const ArrayLike& speeds, std::size_t ticks) {
    const Input speed = input_1d(speeds, "speed");
    const std::size_t n = size();
    if (speed.size() != n)
      throw value_error("speed must have one number for each of the " + std::to_string(n) + " trials");
    if (ticks == 0) throw nb::value_error("ticks must be 1 or more");
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isfinite(speed.data()[i]))
        throw value_error("speed[" + std::to_string(i) + "] must be finite. No tick was made");
    const Running running(*this);
    fleet_.begin();
    const std::size_t block = std::max<std::size_t>(1, ticks_without_signals / std::max<std::size_t>(1, n));
    for (std::size_t done = 0; done < ticks; done += block) {
      {
        const WithoutLock released;
        fleet_.step(speed.data(), std::min(block, ticks - done));
      }
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
    }
    return result(ticks);
  }

  nb::tuple arguments() const {
    return nb::make_tuple(given_.axis, given_.plant, given_.hand, given_.threads, given_.instructions);
  }
  /// For each trial (scene, start, seed, speeds, ticks, begun), as in TrialHistory.
  nb::list histories() {
    const Running running(*this);
    nb::list trials;
    for (std::size_t i = 0; i < size(); ++i) {
      const batch::TrialHistory& h = fleet_.history(i);
      using Move = batch::TrialHistory::Move;
      trials.append(nb::make_tuple(h.scene, to_array(h.start), h.seed, column(h.moves, &Move::speed),
                                   column(h.moves, &Move::ticks), h.begun));
    }
    return trials;
  }
  void restore(const nb::list& trials) {
    must_rest();
    std::vector<batch::TrialHistory> histories;
    for (const nb::handle trial : trials) histories.push_back(history_of(trial));
    const Running running(*this);
    const WithoutLock released;
    fleet_.restore(histories);
  }

  Object<"numpy.typing.NDArray[numpy.bool_]"> in_lanes() const {
    must_rest();
    std::vector<std::size_t> trials(size());
    std::iota(trials.begin(), trials.end(), std::size_t{0});
    return column(trials, [this](std::size_t i) { return fleet_.in_lanes(i); });
  }

 private:
  static batch::TrialHistory history_of(nb::handle trial) {
    const auto require = [](bool holds) {
      if (!holds) throw nb::value_error("this is no state of a Fleet: give what its `state` was, unchanged");
    };
    require(nb::isinstance<nb::tuple>(trial) && nb::len(trial) == 6);
    const auto parts = nb::borrow<nb::tuple>(trial);
    batch::TrialHistory h{};
    Triple start;
    std::size_t begun = 0;
    require(nb::try_cast(parts[0], h.scene) && nb::try_cast(parts[1], start) && nb::try_cast(parts[2], h.seed) &&
            nb::try_cast(parts[5], begun));
    raise_if(check(h.scene));
    h.start = to_vector(start);
    const Input speed = input_1d(parts[3], "speed"), ticks = input_1d(parts[4], "ticks");
    require(is_place(h.start) && speed.size() == ticks.size());
    for (std::size_t i = 0; i < speed.size(); ++i) {
      const double n = ticks.data()[i];
      require(std::isfinite(speed.data()[i]) && n >= 1 && n <= 1e15 && n == std::floor(n));
      if (h.ticks == begun) h.begin();
      h.step(speed.data()[i], static_cast<std::size_t>(n));
    }
    require(h.begun == begun || h.ticks == begun);
    h.begun = begun;
    return h;
  }

  Object<"FleetStep"> result(std::size_t ticks) {
    const std::size_t n = size();
    std::vector<TrialRecord> records;
    std::size_t m = 0;
    for (std::size_t i = 0; i < n; ++i) {
      records.push_back(fleet_.record(i, ticks));
      m = std::max(m, records.back().depth.size());
    }
    const auto table = [&](std::vector<double> TrialRecord::* member) {
      std::vector<double> values(n * m, std::numeric_limits<double>::quiet_NaN());
      for (std::size_t i = 0; i < n; ++i)
        std::copy((records[i].*member).begin(), (records[i].*member).end(),
                  values.begin() + static_cast<std::ptrdiff_t>(i * m));
      return to_numpy(std::move(values), {n, m});
    };
    nb::dict columns;
    columns["force"] = column(records, &TrialRecord::force);
    columns["lowest_force"] = column(records, &TrialRecord::lowest_force);
    columns["highest_force"] = column(records, &TrialRecord::highest_force);
    columns["travel"] = column(records, &TrialRecord::travel);
    columns["speed"] = column(records, &TrialRecord::speed);
    columns["fault"] = column(records, &TrialRecord::fault);
    columns["depth"] = table(&TrialRecord::depth);
    columns["deepest"] = table(&TrialRecord::deepest);
    return columns;
  }

  FleetArguments given_;
  batch::Fleet fleet_;
};

}  // namespace

void bind_fleet(nb::module_& m) {
  auto fleet = nb::class_<Fleet>(
      m, "Fleet", nb::is_final(),
      "Many simulated operators at simulated devices, steered at once along their needles, in SIMD lanes and on "
      "threads.\n\n"
      "The results of a trial do not depend on the other trials, on the number of threads or on the instruction set.");
  def_repr(fleet, "<Fleet of {0.size} trials on {0.threads} threads>");
  fleet
      .def(
          "__init__",
          [](Fleet* self, const Triple& axis, const DeviceDynamics& plant, const Hand& hand,
             const Object<"int">& threads, const std::optional<std::string>& instructions) {
            new (self) Fleet({axis, plant, hand, threads, instructions});
          },
          nb::arg("axis"), nb::arg("plant") = DeviceDynamics{}, nb::arg("hand") = Hand{}, nb::arg("threads") = 0,
          nb::arg("instructions") = nb::none(),
          "A fleet without trials. axis: the direction of all needles. threads: 0 is one for each processor.\n"
          "instructions: one of simd_instructions(); \"portable\" computes each trial alone. Raises ValueError.")
      .def(
          "__reduce__",
          [](nb::handle self) {
            auto& fleet = nb::cast<Fleet&>(self);
            return nb::make_tuple(nb::module_::import_("punctura.restore").attr("restored"),
                                  nb::make_tuple(self.type(), fleet.arguments(), fleet.histories()));
          },
          nb::sig("def __reduce__(self) -> tuple[typing.Any, ...]"))
      .def_prop_rw(
          "state", &Fleet::histories, &Fleet::restore,
          nb::for_getter(nb::sig("def state(self) -> list[tuple[typing.Any, ...]]")),
          nb::for_setter(nb::sig("def state(self, trials: list[tuple[typing.Any, ...]], /) -> None")),
          "What each trial is made of: its scene, start and seed, and the hand's speeds since then. Set it to\n"
          "go back to the bit: all trials make their ticks again, together. Copies and pickles do the same.")
      .def_prop_ro("size", &Fleet::size, "Number of trials")
      .def_prop_ro("threads", &Fleet::threads)
      .def_prop_ro("in_lanes", &Fleet::in_lanes,
                   "(n,) Whether lanes compute the trial. One that came near a fault is computed alone, as is one\n"
                   "whose scene is of another kind than the others in its vector (solver, number of membranes, "
                   "...).")
      .def("place", &Fleet::place, nb::arg("i"), nb::arg("scene"), nb::arg("start"), nb::arg("seed") = 0,
           "Starts trial i anew; i = size adds a trial. start: position of the tip, m. seed: of tremor and encoders.\n"
           "Raises ConfigurationError, ValueError and IndexError.")
      .def("step", &Fleet::step, nb::arg("speed"), nb::arg("ticks"),
           "Makes `ticks` ticks in each trial. speed (n,): of the hand along the needle, m/s. Raises ValueError.\n\n"
           "Runs without Python's lock. After Ctrl-C some ticks were made.");
}

}  // namespace punctura::bindings
