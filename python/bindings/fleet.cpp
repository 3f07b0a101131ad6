// Many experiments that a program steers at once, on threads: the engine of the Gymnasium environments.
#include <atomic>
#include <cmath>
#include <system_error>
#include <thread>

#include "arguments.hpp"
#include "bindings.hpp"
#include "fleet_trial.hpp"
#include "state.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

constexpr std::size_t ticks_without_signals = 100'000;  // of all trials: 0.1 s or less

/// Calls work(i) for i = 0 ... n-1, on at most `threads` threads with this one.
template <typename Work>
void share(std::size_t n, std::size_t threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < n;) work(i);
  };
  std::vector<std::thread> others;
  try {
    while (others.size() + 1 < std::min(threads, n)) others.emplace_back(take);
  } catch (const std::system_error&) {  // the system has no more threads: the ones that run do all the work
  }
  take();
  for (std::thread& other : others) other.join();
}

class Fleet : public OneThread {
 public:
  Fleet(const DeviceDynamics& plant, const Hand& hand, std::size_t threads)
      : plant_(plant),
        hand_(hand),
        threads_(threads != 0 ? threads : std::max(1u, std::thread::hardware_concurrency())) {}

  std::size_t size() const noexcept { return trials_.size(); }
  std::size_t threads() const noexcept { return threads_; }

  /// Makes trial i of a scene that is checked here. i may be size(): then the fleet grows by one.
  void place(std::size_t i, const Scene& scene, const Triple& start, const Triple& axis, std::uint64_t seed) {
    must_rest();
    if (i > trials_.size())
      throw nb::index_error(("the fleet has " + std::to_string(size()) + " trials; the next new one is trial " +
                             std::to_string(size()) + ", not " + std::to_string(i))
                                .c_str());
    raise_if(check(scene));
    if (!is_place(to_vector(start))) throw nb::value_error("start must be a position within 1000 km");
    Trial trial(scene, to_vector(start), unit(axis, "axis"), plant_, hand_, seed);
    if (i == trials_.size())
      trials_.push_back(std::move(trial));
    else
      trials_[i] = std::move(trial);
  }

  nb::dict step(const nb::object& speeds, std::size_t ticks) {
    const Input speed = input_1d(speeds, "speed");
    const std::size_t n = size();
    if (speed.size() != n)
      throw nb::value_error(("speed must have one number for each of the " + std::to_string(n) + " trials").c_str());
    if (ticks == 0) throw nb::value_error("ticks must be 1 or more");
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isfinite(speed.data()[i]))
        throw nb::value_error(("speed[" + std::to_string(i) + "] must be finite. No tick was made").c_str());
    const Running running(*this);
    for (Trial& trial : trials_) trial.begin();
    const std::size_t block = std::max<std::size_t>(1, ticks_without_signals / std::max<std::size_t>(1, n));
    for (std::size_t done = 0; done < ticks; done += block) {
      {
        const WithoutLock released;
        const std::size_t now = std::min(block, ticks - done);
        share(n, threads_, [&](std::size_t i) { trials_[i].step(speed.data()[i], now); });
      }
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
    }
    return result(ticks);
  }

  nb::bytes state(std::size_t i) const {
    must_rest();
    return as_bytes(save_state(at(i)));
  }
  void load(std::size_t i, const nb::bytes& state) {
    must_rest();
    at(i);
    if (!load_state(trials_[i], as_span(state)))
      throw nb::value_error(("these bytes are no state of trial " + std::to_string(i) +
                             ": they are damaged, or of another scene, or of another version of punctura")
                                .c_str());
  }

 private:
  const Trial& at(std::size_t i) const {
    if (i >= trials_.size())
      throw nb::index_error(
          ("the fleet has " + std::to_string(size()) + " trials, and no trial " + std::to_string(i)).c_str());
    return trials_[i];
  }

  nb::dict result(std::size_t ticks) {
    const std::size_t n = size();
    std::vector<const TrialRecord*> records;
    std::size_t m = 0;
    for (Trial& trial : trials_) {
      records.push_back(&trial.end(ticks));
      m = std::max(m, records.back()->depth.size());
    }
    const auto column = [&](double TrialRecord::* member) {
      std::vector<double> values;
      for (const TrialRecord* record : records) values.push_back(record->*member);
      return to_numpy(std::move(values), {n});
    };
    const auto table = [&](std::vector<double> TrialRecord::* member) {
      std::vector<double> values(n * m, std::numeric_limits<double>::quiet_NaN());
      for (std::size_t i = 0; i < n; ++i)
        std::copy((records[i]->*member).begin(), (records[i]->*member).end(),
                  values.begin() + static_cast<std::ptrdiff_t>(i * m));
      return to_numpy(std::move(values), {n, m});
    };
    std::vector<std::uint8_t> faults;
    for (const TrialRecord* record : records) faults.push_back(static_cast<std::uint8_t>(record->fault));
    nb::dict columns;
    columns["force"] = column(&TrialRecord::force);
    columns["lowest_force"] = column(&TrialRecord::lowest_force);
    columns["highest_force"] = column(&TrialRecord::highest_force);
    columns["travel"] = column(&TrialRecord::travel);
    columns["speed"] = column(&TrialRecord::speed);
    columns["fault"] = to_numpy(std::move(faults), {n});
    columns["depth"] = table(&TrialRecord::depth);
    columns["deepest"] = table(&TrialRecord::deepest);
    return columns;
  }

  DeviceDynamics plant_;
  Hand hand_;
  std::size_t threads_;
  std::vector<Trial> trials_;
};

}  // namespace

void bind_fleet(nb::module_& m) {
  auto fleet = nb::class_<Fleet>(
      m, "Fleet", nb::is_final(),
      "Many simulated operators at simulated devices, steered at once along their needles, on threads.\n\n"
      "The results of a trial do not depend on the other trials or on the number of threads.");
  def_repr(fleet, "<Fleet of {0.size} trials on {0.threads} threads>");
  fleet
      .def(
          "__init__",
          [](Fleet* self, const DeviceDynamics& plant, const Hand& hand, const nb::object& threads) {
            new (self) Fleet(plant, hand, threads_from(threads));
          },
          nb::arg("plant") = DeviceDynamics{}, nb::arg("hand") = Hand{}, nb::arg("threads") = 0,
          nb::sig("def __init__(self, plant: Plant = ..., hand: Hand = ..., threads: int = 0) -> None"),
          "A fleet without trials. threads: 0 is one for each processor.")
      .def_prop_ro("size", &Fleet::size, "Number of trials")
      .def_prop_ro("threads", &Fleet::threads)
      .def("place", &Fleet::place, nb::arg("i"), nb::arg("scene"), nb::arg("start"), nb::arg("axis"),
           nb::arg("seed") = 0,
           "Starts trial i anew; i = size adds a trial. start: position of the tip, m. axis: the needle's direction.\n"
           "seed: of tremor and encoders. Raises ConfigurationError, ValueError and IndexError.")
      .def("step", &Fleet::step, nb::arg("speed"), nb::arg("ticks"),
           nb::sig("def step(self, speed: numpy.typing.ArrayLike, ticks: int) -> FleetStep"),
           "Makes `ticks` ticks in each trial. speed (n,): of the hand along the needle, m/s. Raises ValueError.\n\n"
           "Runs without Python's lock. After Ctrl-C some ticks were made.")
      .def("state", &Fleet::state, nb::arg("i"), "The complete state of trial i as bytes. Raises IndexError.")
      .def("load", &Fleet::load, nb::arg("i"), nb::arg("state"),
           "Trial i continues from bytes of state(), with the same results, bit for bit. Raises ValueError.");
}

}  // namespace punctura::bindings
