// runtime: the live loop.
#include "bindings.hpp"

namespace punctura::bindings {
void bind_runtime(nb::module_&) {}
}  // namespace punctura::bindings
