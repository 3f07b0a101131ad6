// Table of contents: one file per room of core/punctura.
#include <string>
#include <utility>

#include "bindings.hpp"

NB_MODULE(core_of_nanobind, m) {
  using namespace punctura::bindings;
  static bool loaded = false;
  if (std::exchange(loaded, true))
    throw nb::import_error(
        "punctura was imported before in this process, and its compiled core can be loaded only once: keep that module "
        "in sys.modules, or begin a new process");
  nb::set_leak_warnings(false);  // a daemon thread may legitimately hold a device until the interpreter exits
  m.doc() = "The compiled core of Punctura. SI units throughout: m, N, s, rad, N/m.";
  m.def("version", [] { return PUNCTURA_VERSION; }, "Of Punctura.");
  const std::string base = nb::cast<std::string>(m.attr("__name__")) + ".PuncturaError";
  m.attr("PuncturaError") = nb::steal(PyErr_NewExceptionWithDoc(
      base.c_str(), "Base class of all exceptions of Punctura. An argument of a wrong type raises TypeError.", nullptr,
      nullptr));
  bind_model(m);
  bind_profile_law(m);
  bind_proxy(m);
  bind_syringe(m);
  bind_membrane(m);
  bind_tissue_law(m);
  bind_scene(m);
  bind_scene_keys(m);
  bind_insertion(m);
  bind_events(m);
  bind_trace(m);
  bind_plant(m);
  bind_experiment(m);
  bind_rivals(m);
  bind_fleet(m);
  bind_live_estimate(m);
  bind_limits(m);
  bind_tick_table(m);
  bind_thumb(m);
  bind_runtime(m);
  bind_python_devices(m);
  bind_devices(m);
  bind_replay(m);
  bind_batch(m);
  bind_scene_batch(m);
  explain_calls(m);  // the last: it goes through everything above
}

// Nanobind's tables are those of a process. A subinterpreter would exchange them for its own: from then on, the main
// interpreter would not know its own types.
extern "C" NB_EXPORT PyObject* PyInit__core() {
  if (PyInterpreterState_GetID(PyInterpreterState_Get()) == 0) return PyInit_core_of_nanobind();
  PyErr_SetString(PyExc_ImportError,
                  "punctura works in the main interpreter of a process, not in a subinterpreter: begin a process for "
                  "it, such as with multiprocessing");
  return nullptr;
}
