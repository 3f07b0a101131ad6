// core/punctura/lab/trace: the force along a measured motion, with exact derivatives.
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include "bindings.hpp"
#include "punctura/lab/trace/trace_model.hpp"
#include "value.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

using FloatsPair = std::tuple<Floats, Floats>;

nb::tuple names_of(std::span<const Field> fields) {
  std::vector<std::string> names;
  for (const Field& field : fields) names.emplace_back(field.name);
  return shown_tuple(names);
}

struct TraceParameters {
  std::vector<TraceMembrane> membranes;
  TraceCoupling coupling;
};
TraceParameters parameters_of(const Needle& needle, const nb::object& membranes, const nb::object& coupling) {
  const Input given = input(membranes, "membranes"), shared = input(coupling, "coupling");
  if (given.ndim() != 2 || given.shape(1) != trace_membrane_fields.size())
    throw nb::value_error("membranes must be (m, k): see TraceModel.membrane_names");
  if (shared.ndim() != 1 || shared.shape(0) != trace_coupling_fields.size())
    throw nb::value_error("coupling must be (6,): see TraceModel.coupling_names");
  std::vector<TraceMembrane> m(given.shape(0));
  for (std::size_t i = 0; i < m.size(); ++i) std::copy_n(given.data() + i * m[i].size(), m[i].size(), m[i].begin());
  TraceCoupling c;
  std::copy_n(shared.data(), c.size(), c.begin());
  raise_if(problems_of_trace(needle, m, c));
  return {std::move(m), c};
}

/// The depths behind the surfaces at which a slow needle pops (m,), and their derivatives (m, 6 + k, or 0).
FloatsPair pop_depths(const Needle& needle, const ArrayLike& membranes, const ArrayLike& coupling, bool jacobian) {
  const auto [m, c] = parameters_of(needle, membranes, coupling);
  std::vector<double> depths, rows;
  for (const TraceMembrane& membrane : m) {
    if (!jacobian) {
      depths.push_back(trace_pop<double>(needle, membrane, c));
      continue;
    }
    const auto pop = trace_pop(needle, membrane, c);
    depths.push_back(pop.value);
    rows.insert(rows.end(), pop.d.begin(), pop.d.end());
  }
  const std::size_t columns = jacobian ? trace_parameters(1) : 0;
  return {to_numpy(std::move(depths), {m.size()}), to_numpy(std::move(rows), {m.size(), columns})};
}

/// A measured motion, and the needle that made it. It does not change, so that any number of threads can use it.
class TraceModel {
 public:
  TraceModel(Needle needle, const nb::object& depth, const nb::object& time)
      : needle_(needle), depth_(values(depth, "depth")) {
    if (!time.is_none()) time_ = values(time, "time");
    if (!time_.empty() && time_.size() != depth_.size())
      throw nb::value_error("time and depth must have the same length");
    for (std::size_t i = 1; i < time_.size(); ++i)
      if (!(time_[i] > time_[i - 1])) throw nb::value_error("time must ascend");
  }

  std::string text() const {
    return "<TraceModel of " + std::to_string(depth_.size()) + (time_.empty() ? " depths>" : " depths with times>");
  }

  FloatsPair forces(const ArrayLike& membranes, const ArrayLike& coupling, bool jacobian,
                    const std::vector<std::string>& by) const {
    const auto [m, c] = parameters_of(needle_, membranes, coupling);
    const auto wanted = flags(by);
    const std::size_t n = depth_.size(), columns = jacobian ? trace_parameters(m.size()) : 0;
    std::vector<double> force(n), rows(n * columns);
    {
      const WithoutLock without;
      trace_forces({needle_, depth_, time_}, m, c, force, rows, by.empty() ? std::span<const bool>{} : wanted);
    }
    return {to_numpy(std::move(force), {n}), to_numpy(std::move(rows), {n, columns})};
  }

 private:
  static std::array<bool, trace_parameters(1)> flags(const std::vector<std::string>& names) {
    std::array<bool, trace_parameters(1)> wanted{};
    for (const std::string& name : names) {
      const auto place = [&](const auto& fields) {
        return static_cast<std::size_t>(std::ranges::find(fields, name, &Field::name) - fields.begin());
      };
      std::size_t at = place(trace_coupling_fields);
      if (at == trace_coupling_fields.size()) at += place(trace_membrane_fields);
      if (at == wanted.size()) throw nb::value_error("by: see membrane_names");
      wanted[at] = true;
    }
    return wanted;
  }
  static std::vector<double> values(const nb::object& given, const char* name) {
    const Input array = input(given, name);
    if (array.ndim() != 1) throw value_error(std::string(name) + " must be (n,)");
    for (std::size_t i = 0; i < array.size(); ++i)
      if (!std::isfinite(array.data()[i])) throw value_error(std::string(name) + " must be finite");
    return {array.data(), array.data() + array.size()};
  }

  Needle needle_;
  std::vector<double> depth_, time_;
};

}  // namespace

void bind_trace(nb::module_& m) {
  nb::class_<TraceModel> model(m, "TraceModel",
                               "The model's force along a measured motion, with exact derivatives. It never changes: "
                               "threads may share it.");
  model.def(nb::init<Needle, const ArrayLike&, const ArrayLike&>(), nb::arg("needle"), nb::arg("depth"),
            nb::arg("time") = nb::none(),
            "depth: of the tip, (n,), m. time: (n,), s, ascending; None if nothing depends on time.");
  model.def("__repr__", &TraceModel::text);
  model.def("forces", &TraceModel::forces, nb::arg("membranes"), nb::arg("coupling"), nb::arg("jacobian") = true,
            nb::arg("by") = std::vector<std::string>{},
            "The force that resists insertion (n,), N, and its derivatives (n, 6 + k m): by the coupling, then by "
            "each membrane.\n\nmembranes: (m, k), coupling: (6,), SI, in the order of membrane_names and "
            "coupling_names. by: names of parameters; derivatives by others are 0 (default: none is left out). Raises "
            "ConfigurationError, ValueError.");
  model.def_static("pop_depths", &pop_depths, nb::arg("needle"), nb::arg("membranes"), nb::arg("coupling"),
                   nb::arg("jacobian") = true,
                   "How far behind each surface the tip of a slow needle is when it pops (m,), m, and the derivatives "
                   "(m, 6 + k): by the coupling, then by the membrane.");
  model.def_prop_ro_static(
      "membrane_names", [](nb::handle) { return names_of(trace_membrane_fields); },
      nb::sig("def membrane_names(cls, /) -> tuple[str, ...]"),
      "The parameters of a membrane, in the order of the columns of `membranes`.");
  model.def_prop_ro_static(
      "coupling_names", [](nb::handle) { return names_of(trace_coupling_fields); },
      nb::sig("def coupling_names(cls, /) -> tuple[str, ...]"),
      "The parameters of the coupling, in the order of `coupling`.");
  model.def_prop_ro_static(
      "units",
      [](nb::handle) {
        nb::dict units;
        const auto add = [&](const Field& field) { units[nb::str(field.name.data(), field.name.size())] = field.unit; };
        for (const Field& field : trace_membrane_fields) add(field);
        for (const Field& field : trace_coupling_fields) add(field);
        return units;
      },
      nb::sig("def units(cls, /) -> dict[str, str]"), "The unit of each parameter, SI.");
}

}  // namespace punctura::bindings
