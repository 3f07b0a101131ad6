// The functions of FMI 2.0 for co-simulation, and what they need of its types. https://fmi-standard.org, version 2.0.4
#include <charconv>
#include <limits>

#include "component.hpp"

using namespace punctura_fmi;

namespace {

struct Callbacks {
  void (*logger)(void* environment, const char* instance, int status, const char* category, const char* message, ...);
  void* (*allocate)(std::size_t, std::size_t);
  void (*free)(void*);
  void (*step_finished)(void*, int);
  void* environment;
};

struct Component2 final : Component {
  void log(const char* text) const noexcept override {
    if (logger) logger(environment, name.c_str(), error, "error", "%s", text);
  }
  std::string name;
  void (*logger)(void*, const char*, int, const char*, const char*, ...) = nullptr;
  void* environment = nullptr;
};

/// The folder of "file:///path" or "file:/path", with %20 for a space. Another % is itself.
std::string folder_of(const char* uri) {
  std::string text = uri ? uri : "";
  if (text.rfind("file://", 0) == 0)
    text.erase(0, 7);
  else if (text.rfind("file:", 0) == 0)
    text.erase(0, 5);
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      path += static_cast<char>(byte);
      i += 2;
    } else {
      path += text[i];
    }
  }
#ifdef _WIN32
  if (path.size() > 2 && path[0] == '/' && path[2] == ':') path.erase(0, 1);
#endif
  return path;
}

}  // namespace

EXPORT const char* fmi2GetTypesPlatform() { return "default"; }
EXPORT const char* fmi2GetVersion() { return "2.0"; }
EXPORT int fmi2SetDebugLogging(void*, int, std::size_t, const char* const*) { return ok; }

EXPORT void* fmi2Instantiate(const char* name, int kind, const char*, const char* resources, const Callbacks* callbacks,
                             int, int) {
  try {
    auto made = std::make_unique<Component2>();
    made->name = name ? name : "";
    if (callbacks) made->logger = callbacks->logger, made->environment = callbacks->environment;
    return instantiate(std::move(made), folder_of(resources),
                       kind == 1 ? "" : "this FMU is for co-simulation, not for model exchange");
  } catch (...) {
    return nullptr;
  }
}
EXPORT void fmi2FreeInstance(void* c) { delete static_cast<Component*>(c); }

EXPORT int fmi2SetupExperiment(void* c, int, double, double start, int has_stop, double stop) {
  return call(c, Call::setup, __func__, [&](Instance& instance) {
    return instance.set_times(start, has_stop ? stop : std::numeric_limits<double>::infinity());
  });
}
EXPORT int fmi2EnterInitializationMode(void* c) {
  return call(c, Call::enter, __func__, [](Instance&) { return true; });
}
EXPORT int fmi2ExitInitializationMode(void* c) {
  return call(c, Call::leave, __func__, [](Instance& instance) { return instance.begin(); });
}
EXPORT int fmi2Terminate(void* c) {
  return call(c, Call::terminate, __func__, [](Instance&) { return true; });
}
EXPORT int fmi2Reset(void* c) {
  return call(c, Call::reset, __func__, [](Instance& instance) { return instance.reset(); });
}

EXPORT int fmi2GetReal(void* c, const unsigned* references, std::size_t n, double* values) {
  return get_all(c, __func__, Kind::real, references, n, values, n);
}
EXPORT int fmi2GetInteger(void* c, const unsigned* references, std::size_t n, int* values) {
  return get_all(c, __func__, Kind::integer, references, n, values, n);
}
EXPORT int fmi2GetBoolean(void* c, const unsigned* references, std::size_t n, int* values) {
  return get_all(c, __func__, Kind::boolean, references, n, values, n);
}
EXPORT int fmi2GetString(void* c, const unsigned*, std::size_t n, const char**) {
  return n == 0 ? ok : refuse(c, __func__);
}
EXPORT int fmi2SetReal(void* c, const unsigned* references, std::size_t n, const double* values) {
  return set_all(c, __func__, Kind::real, references, n, values, n);
}
EXPORT int fmi2SetInteger(void* c, const unsigned* references, std::size_t n, const int* values) {
  return set_all(c, __func__, Kind::integer, references, n, values, n);
}
EXPORT int fmi2SetBoolean(void* c, const unsigned* references, std::size_t n, const int* values) {
  return set_all(c, __func__, Kind::boolean, references, n, values, n);
}
EXPORT int fmi2SetString(void* c, const unsigned*, std::size_t n, const char* const*) {
  return n == 0 ? ok : refuse(c, __func__);
}

EXPORT int fmi2SetRealInputDerivatives(void* c, const unsigned* references, std::size_t n, const int* orders,
                                       const double* values) {
  return call(c, Call::derive, __func__, [&](Instance& instance) {
    for (std::size_t i = 0; i < n; ++i)
      if (!instance.derivable(references[i], orders[i], values[i])) return false;
    for (std::size_t i = 0; i < n; ++i) instance.set_derivative(references[i], values[i]);
    return true;
  });
}
EXPORT int fmi2GetRealOutputDerivatives(void* c, const unsigned*, std::size_t, const int*, double*) {
  return refuse(c, __func__);
}
EXPORT int fmi2GetDirectionalDerivative(void* c, const unsigned*, std::size_t, const unsigned*, std::size_t,
                                        const double*, double*) {
  return refuse(c, __func__);
}

EXPORT int fmi2DoStep(void* c, double time, double duration, int) {
  return call(c, Call::step, __func__, [&](Instance& instance) { return instance.step(time, duration); });
}
EXPORT int fmi2CancelStep(void* c) { return refuse(c, __func__); }
EXPORT int fmi2GetStatus(void*, int, int*) { return discard; }
EXPORT int fmi2GetRealStatus(void* c, int kind, double* value) {
  if (!c || kind != 2) return discard;  // only the last successful time
  *value = static_cast<Component*>(c)->instance->time();
  return ok;
}
EXPORT int fmi2GetIntegerStatus(void*, int, int*) { return discard; }
EXPORT int fmi2GetBooleanStatus(void* c, int kind, int* value) {
  if (!c || kind != 3) return discard;  // "terminated": never
  *value = 0;
  return ok;
}
EXPORT int fmi2GetStringStatus(void*, int, const char**) { return discard; }

EXPORT int fmi2GetFMUstate(void* c, void** state) { return get_state(c, __func__, state); }
EXPORT int fmi2SetFMUstate(void* c, void* state) { return set_state(c, __func__, state); }
EXPORT int fmi2FreeFMUstate(void*, void** state) { return free_state(state); }
EXPORT int fmi2SerializedFMUstateSize(void* c, void* state, std::size_t* size) {
  return state_size(c, __func__, state, size);
}
EXPORT int fmi2SerializeFMUstate(void* c, void* state, char* bytes, std::size_t size) {
  return serialize(c, __func__, state, bytes, size);
}
EXPORT int fmi2DeSerializeFMUstate(void* c, const char* bytes, std::size_t size, void** state) {
  return deserialize(c, __func__, bytes, size, state);
}
