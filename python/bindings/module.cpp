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
  for (Bind* bind : {bind_model,          bind_profile_law, bind_proxy,      bind_syringe,   bind_membrane,
                     bind_tissue_law,     bind_scene,       bind_scene_keys, bind_insertion, bind_events,
                     bind_trace,          bind_plant,       bind_experiment, bind_rivals,    bind_fleet,
                     bind_live_estimate,  bind_limits,      bind_tick_table, bind_thumb,     bind_runtime,
                     bind_python_devices, bind_devices,     bind_replay,     bind_batch,     bind_scene_batch})
    bind(m);
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
