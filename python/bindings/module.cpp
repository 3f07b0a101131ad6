// Table of contents: one file per room of core/punctura.
#include <string>

#include "bindings.hpp"

NB_MODULE(_core, m) {
  using namespace punctura::bindings;
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
