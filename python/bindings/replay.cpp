// Replays a recording: runs its inputs through the servo step again.
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "punctura_runtime/loop/step_maker.hpp"
#include "state.hpp"
#include "tick_columns.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

std::string compiler() {
#if defined(__clang__)
  std::string name = "Clang " __clang_version__;
#elif defined(__GNUC__)
  std::string name = "GCC " __VERSION__;
#elif defined(_MSC_VER)
  std::string name = "MSVC " + std::to_string(_MSC_FULL_VER);
#else
  std::string name = "unknown compiler";
#endif
#ifdef __FMA__
  name += " fma";
#endif
  return name;
}

/// The inputs of recorded ticks, read by the table of tick fields.
class InputColumns {
 public:
  /// columns: punctura.Ticks, or any mapping. Throws KeyError for a missing field, ValueError for a wrong shape.
  explicit InputColumns(const nb::object& columns) {
    const nb::object as_array = nb::module_::import_("numpy").attr("ascontiguousarray");
    rows_ = nb::len(nb::object(columns["tick"]));
    each(*this, [&](const auto& field, auto& values) {
      using T = typename std::remove_reference_t<decltype(values)>::value_type;
      const nb::object given = columns[field.name];
      const auto array = nb::cast<nb::ndarray<nb::numpy, const T, nb::c_contig, nb::device::cpu>>(
          as_array(real_numbers(given, field.name, dtype_name<T>().c_str())));
      if (array.ndim() == 0 || array.shape(0) != rows_ || array.size() != rows_ * width<decltype(field)>)
        throw std::invalid_argument(std::string(field.name) + " must have one row for each tick");
      values.assign(array.data(), array.data() + array.size());
    });
  }
  std::size_t rows() const noexcept { return rows_; }

  /// Copies the sample and the commands of a row into a snapshot.
  void read(std::size_t row, Snapshot& into) const {
    each(*this, [&](const auto& field, const auto& values) {
      auto& value = field.get(into);
      if constexpr (width<decltype(field)> == 3)
        std::copy_n(&values[3 * row], 3, value.begin());
      else
        value = static_cast<std::remove_reference_t<decltype(value)>>(values[row]);
    });
  }

 private:
  template <typename Field>
  static constexpr std::size_t width = FieldStore<Field>::width;

  template <typename Self, typename Do>
  static void each(Self& self, Do&& act) {
    for_each_field(tick_table, [&](const auto& field, auto i) {
      if constexpr (is_of<Snapshot, decltype(field)>)
        if (field.use & use_input) act(field, std::get<i>(self.columns_));
    });
  }

  ColumnsOf<decltype(tick_table)> columns_;
  std::size_t rows_ = 0;
};

/// A servo step that gets the recorded inputs in the order of the original loop.
class Replay : public OneThread {
 public:
  Replay(const Scene& scene, const GateLimits& gate, const ForceLimits& limits, double spent, StepMaker model)
      : rate_(scene.servo.rate), gate_(gate), limits_(limits), model_(std::move(model)), step_(built(scene)) {
    step_->guard().set_spent(spent);
  }

  TicksObject run(const Object<"typing.Any">& ticks, const std::vector<std::vector<Scene>>& scenes) {
    const InputColumns given(ticks);
    Snapshot now{};
    std::size_t asked = 0;
    for (std::size_t k = 0; k < given.rows(); ++k) {
      given.read(k, now);
      asked += (now.commands & command_scene) != 0;
    }
    if (asked != scenes.size()) throw std::invalid_argument("there must be scenes for every tick that took one");

    TickColumns columns;
    columns.reserve(given.rows(), step_->guard().snapshot().membrane_count);
    auto taken = scenes.begin();
    const Running running(*this);
    make_ticks(given.rows(), [&](std::size_t k) {
      given.read(k, now);
      if (now.commands & command_scene)
        for (const Scene& scene : *taken++) take(scene);
      if (now.commands & command_reset) step_->reset();
      if (now.commands & command_arm) step_->guard().arm();
      if (now.commands & command_disarm) step_->guard().disarm();
      columns.add(step_->step(now.sample));
    });
    return columns.to_ticks();
  }

  double rate() const noexcept { return rate_; }

 private:
  std::unique_ptr<AnyStep> built(Scene scene) const {
    scene.servo.rate = rate_;  // the device's rate, as in the loop
    return model_(scene, gate_, limits_);
  }
  void take(const Scene& scene) {
    auto next = built(scene);
    next->resume(*step_);
    step_ = std::move(next);
  }

  double rate_;
  GateLimits gate_;
  ForceLimits limits_;
  StepMaker model_;
  std::unique_ptr<AnyStep> step_;
};

}  // namespace

void bind_replay(nb::module_& m) {
  m.def("compiler", &compiler, "Name and version of the compiler of the core.");

  auto replay = nb::class_<Replay>(m, "Replay", "Runs recorded inputs through the servo step of a loop again.");
  def_repr(replay, "<Replay at {0.rate:g} Hz>");
  replay
      .def(
          "__init__",
          [](Replay* self, const Scene& scene, const GateLimits& gate, const ForceLimits& limits, double spent,
             const std::vector<AnyRival>& rivals) {
            new (self) Replay(scene, gate, limits, spent, StepMaker::with_rivals(rivals));
          },
          nb::arg("scene"), nb::arg("gate"), nb::arg("limits"), nb::arg("spent") = 0.0, nb::kw_only(),
          nb::arg("rivals") = std::vector<AnyRival>(),
          "Starts in the state of a loop before its first tick. scene: at the device's rate. spent: motor load\n"
          "before the run, N^2 s. rivals: of the loop.")
      .def_prop_ro("rate", &Replay::rate, "Hz")
      .def("run", &Replay::run, nb::arg("ticks"), nb::arg("scenes"),
           "Computes ticks from inputs. ticks: Ticks or a mapping with all input fields. scenes: a list of the taken\n"
           "scenes, in order, for each tick whose commands say that it took a scene.");
}

}  // namespace punctura::bindings
