// core/punctura/proxy: the discrete-time systems of K06 section 3.
#include "bindings.hpp"

namespace punctura::bindings {
void bind_proxy(nb::module_&) {}
}  // namespace punctura::bindings
