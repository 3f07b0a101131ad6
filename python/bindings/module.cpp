// Table of contents: one file per room of core/punctura.
#include "bindings.hpp"

NB_MODULE(_core, m) {
  using namespace punctura::bindings;
  m.doc() = "The compiled core of Punctura. SI units throughout: m, N, s, rad, N/m.";
  bind_model(m);
  bind_proxy(m);
  bind_scene(m);
  bind_insertion(m);
  bind_plant(m);
  bind_experiment(m);
  bind_limits(m);
  bind_runtime(m);
  bind_given_devices(m);
  bind_devices(m);
  bind_replay(m);
}
