// runtime/punctura_runtime/batch: many independent trials computed together.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/variant.h>

#include <optional>

#include "bindings.hpp"
#include "punctura/scene/check.hpp"
#include "punctura_runtime/batch/line_batch.hpp"
#include "simd_code.hpp"
#include "state.hpp"
#include "ticks.hpp"
#include "value.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

using batch::Grid;
using batch::LineBatch;

using Law = std::variant<GivenThinLaw, GivenThickLaw, GivenProfileLaw>;

/// One for each trial, or a single one for all.
template <typename T>
struct Given {
  Given(const nb::object& given, const char* name, const char* wanted, std::optional<std::size_t>& trials)
      : single(!nb::isinstance<nb::sequence>(given)) {
    const auto add = [&](const nb::object& one) {
      try {
        all.push_back(nb::cast<T>(one));
      } catch (const nb::cast_error&) {
        throw type_error(std::string(name) + " must be " + wanted + ", not " +
                         nb::cast<std::string>(nb::type_name(one.type())));
      }
    };
    if (single) {
      add(given);
      return;
    }
    const std::size_t n = nb::len(given);
    if (n != trials.value_or(n))
      throw value_error(std::string(name) + " has length " + std::to_string(n) + ", and the number of trials is " +
                        std::to_string(*trials) + ": give one for each trial, or a single one for all");
    trials = n;
    all.reserve(n);
    for (std::size_t i = 0; i < n; ++i) add(given[i]);
  }
  const T& of(std::size_t trial) const { return all[single ? 0 : trial]; }
  nb::object argument() const { return single ? nb::cast(all.front()) : nb::cast(all); }

  bool single;
  std::vector<T> all;
};

/// A LineBatch that keeps its constructor arguments. Copies share the laws.
class LawBatch : public LineBatch, public OneThread {
 public:
  LawBatch(std::shared_ptr<const Given<Law>> laws, Given<Coupling> couplings, double period, Solver solver,
           std::size_t trials)
      : LineBatch(period, solver), laws_(std::move(laws)), couplings_(std::move(couplings)) {
    reserve(trials);
    for (std::size_t i = 0; i < trials; ++i)
      std::visit([&](const auto& law) { add(law.pieces(), couplings_.of(i)); }, laws_->of(i));
  }

  void describe(auto& parameters) const {
    LineBatch::describe(parameters);
    for (const Law& one : laws_->all) std::visit([&](const auto& law) { law.pieces().describe(parameters); }, one);
  }
  nb::tuple arguments() const {
    return nb::make_tuple(laws_->argument(), couplings_.argument(), period(), Word(solver()), trials());
  }

 private:
  std::shared_ptr<const Given<Law>> laws_;
  Given<Coupling> couplings_;
};

constexpr std::size_t most_trials = 1'000'000'000;

void make(LawBatch* self, const nb::object& law, const nb::object& coupling, double period, const Word<Solver>& solver,
          const nb::object& count) {
  std::optional<std::size_t> trials;
  if (!count.is_none()) trials = count_from(count, "trials", 0, most_trials);
  auto laws = std::make_shared<const Given<Law>>(law, "law", "a ThinLaw, ThickLaw or ProfileLaw", trials);
  Given<Coupling> couplings(coupling, "coupling", "a Coupling", trials);
  std::vector<Problem> problems;
  for (const Coupling& one : couplings.all)
    if (problems.empty()) check(one, problems);
  check_period(period, problems);
  raise_if(problems);
  const std::size_t n = trials.value_or(1);
  enough_memory(sizeof(batch::LineBlock) / static_cast<double>(batch::block_lanes) * static_cast<double>(n),
                std::to_string(n) + " trials", "Take fewer trials.");
  new (self) LawBatch(std::move(laws), std::move(couplings), period, solver.at("solver"), n);
}

/// An array of float64 with any strides, without a copy if it already is one.
using Depths = nb::ndarray<const double, nb::device::cpu>;
using Forces = nb::ndarray<double, nb::ndim<2>, nb::device::cpu>;

/// Whether two elements of an array are at the same place. Also true of some layouts that interleave rows and do not
/// overlap, which nobody needs.
bool overlaps_itself(const Forces& array) {
  std::size_t inner = array.shape(0), outer = array.shape(1);
  if (inner == 0 || outer == 0) return false;
  auto close = std::abs(array.stride(0)), far = std::abs(array.stride(1));
  if (close > far || (close == far && inner == 1)) {
    std::swap(inner, outer);
    std::swap(close, far);
  }
  if (inner > 1 && close == 0) return true;
  return outer > 1 && far <= static_cast<std::int64_t>(inner - 1) * close;
}

Floats run(LawBatch& self, const ArrayLike& depths, const Floats& out, const Object<"int">& threads,
           const Object<"int">& block, const std::optional<std::string>& instructions,
           const ProgressArgument& progress) {
  const nb::object numpy = nb::module_::import_("numpy");
  const nb::object given = real_numbers(depths, "p");
  const auto p = nb::cast<Depths>(given);
  const std::size_t n = self.trials();
  const bool shared = p.ndim() == 1;
  if (!shared && !(p.ndim() == 2 && p.shape(1) == n))
    throw value_error("p must have shape (ticks,), the same motion for all trials, or (ticks, " + std::to_string(n) +
                      "), one column for each trial");
  const std::size_t ticks = p.shape(0);
  const Grid<const double> motion{p.data(), p.stride(0), shared ? 0 : p.stride(1)};
  nb::object result = out;
  if (result.is_none()) {
    const bool by_trial = !shared && p.stride(0) < p.stride(1);  // the same order in memory as p
    enough_memory(sizeof(double) * static_cast<double>(n) * static_cast<double>(ticks),
                  std::to_string(ticks) + " rows of forces", "Take fewer ticks at a time.");
    result = numpy.attr("empty")(nb::make_tuple(ticks, n), numpy.attr("float64"), by_trial ? "F" : "C");
  }
  Forces array;
  if (!nb::try_cast(result, array, false) || array.shape(0) != ticks || array.shape(1) != n)
    throw value_error("out must be a writable float64 array of shape (" + std::to_string(ticks) + ", " +
                      std::to_string(n) + ")");
  if (!out.is_none() && overlaps_itself(array))
    throw nb::value_error("out overlaps itself: some of its elements are at the same place. Give an array of its own");
  const bool same = array.data() == p.data() && array.stride(0) == motion.by_tick && array.stride(1) == motion.by_trial;
  if (!out.is_none() && !same && nb::cast<bool>(numpy.attr("may_share_memory")(out, given)) &&
      nb::cast<bool>(numpy.attr("shares_memory")(out, given)))
    throw nb::value_error("out overlaps p: give p itself, or an array of its own");
  const Grid<double> force{array.data(), array.stride(0), array.stride(1)};
  const Progress reporter(progress);
  batch::RunOptions options = options_of(threads, instructions, reporter);
  options.block = count_from(block, "block", 1, 1u << 20);
  const OneThread::Running running(self);
  LineBatch::Outcome outcome;
  {
    const WithoutLock without;
    outcome = self.run(ticks, motion, force, options);
  }
  if (outcome.bad) {
    const std::string place =
        "p[" + std::to_string(outcome.bad->tick) + (shared ? "" : ", " + std::to_string(outcome.bad->trial)) + "]";
    throw value_error(place +
                      " is no finite position within 1000 km: leave such ticks out, or fill them in. "
                      "All trials keep the state from before");
  }
  reporter.report(1, 1);
  return result;
}

}  // namespace

void bind_batch(nb::module_& m) {
  m.def(
      "simd_instructions",
      [] {
        std::vector<std::string> names;
        for (const batch::LineCode* code : batch::line_codes()) names.emplace_back(code->name);
        return names;
      },
      "The instruction sets that a batch can use on this processor, the fastest first.");

  auto line = nb::class_<LawBatch>(
      m, "LineBatch", nb::is_final(),
      "Many independent trials of a proxy on a line, computed together. K06 section 3.1, (33)\n\n"
      "Each trial gets the bits that Proxy1d gives, whatever the instruction set, the block and the threads are.");
  def_state(line);
  def_reset(line, "Resets all trials to the state before the first tick.");
  def_repr(line, "<LineBatch of {0.trials} trials>");
  line.def("__init__", &make, nb::arg("law").none(), nb::arg("coupling").none(), nb::arg("period"),
           nb::arg("solver") = "exact", nb::arg("trials") = nb::none(),
           nb::sig(
               "def __init__(self, law: ThinLaw | ThickLaw | ProfileLaw | Sequence[ThinLaw | ThickLaw | ProfileLaw], "
               "coupling: Coupling | Sequence[Coupling], period: float, solver: typing.Literal['exact', 'paper'] "
               "= 'exact', trials: int | None = None) -> None"),
           "law, coupling: one for each trial, or a single one for all. period: T, s. trials: how many, if both are\n"
           "single. Raises ConfigurationError, ValueError.")
      .def("run", &run, nb::arg("p"), nb::kw_only(), nb::arg("out") = nb::none(), nb::arg("threads") = nb::none(),
           nb::arg("block") = 256, nb::arg("instructions") = nb::none(), nb::arg("progress") = nb::none(),
           "Makes the next ticks of all trials. Returns the forces on the devices, (ticks, trials), N.\n\n"
           "p: depths, m, (ticks,) for the same motion in all trials, or (ticks, trials). A transposed array is read\n"
           "without a copy, and the forces then have the same order in memory. out: an array for the forces.\n"
           "threads: default: one for each processor. block: trials that a thread computes together. instructions:\n"
           "one of simd_instructions(). progress, Ctrl-C: see Insertion.run. Raises ValueError, and all trials then\n"
           "keep the state from before.")
      .def_prop_ro("trials", &LawBatch::trials)
      .def_prop_ro("period", &LawBatch::period, "T, s")
      .def_prop_ro("solver", [](const LawBatch& self) { return Word(self.solver()); })
      .def_prop_ro("nbytes", &LawBatch::bytes, "Memory of constants and states, bytes, without the laws");
}

}  // namespace punctura::bindings
