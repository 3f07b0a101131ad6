// The functions of FMI 2.0 for co-simulation, and what they need of its types. https://fmi-standard.org, version 2.0.4
#include <cstring>
#include <exception>
#include <utility>

#include "instance.hpp"

using punctura_fmi::Instance;
using punctura_fmi::Saved;

namespace {

enum Status : int { ok, warning, discard, error, fatal, pending };

struct Callbacks {
  void (*logger)(void* environment, const char* instance, int status, const char* category, const char* message, ...);
  void* (*allocate)(std::size_t, std::size_t);
  void (*free)(void*);
  void (*step_finished)(void*, int);
  void* environment;
};

struct Component {
  std::unique_ptr<Instance> instance;
  std::string name;
  void (*logger)(void*, const char*, int, const char*, const char*, ...) = nullptr;
  void* environment = nullptr;
};

Component& component(void* c) { return *static_cast<Component*>(c); }

/// Calls f(instance). Says why it failed. No exception crosses the border.
template <typename F>
int call(void* c, F&& f) noexcept {
  if (!c) return error;
  Component& all = component(c);
  try {
    if (f(*all.instance)) return ok;
    if (all.logger) all.logger(all.environment, all.name.c_str(), error, "error", "%s", all.instance->error().c_str());
  } catch (const std::exception& e) {
    if (all.logger) all.logger(all.environment, all.name.c_str(), error, "error", "%s", e.what());
  }
  return error;
}

template <typename Value>
int get_all(void* c, const unsigned* references, std::size_t count, Value* values) noexcept {
  return call(c, [&](Instance& instance) {
    for (std::size_t i = 0; i < count; ++i)
      if (!instance.get(references[i], values[i])) return false;
    return true;
  });
}
template <typename Value>
int set_all(void* c, const unsigned* references, std::size_t count, const Value* values) noexcept {
  return call(c, [&](Instance& instance) {
    for (std::size_t i = 0; i < count; ++i)
      if (!instance.set(references[i], values[i])) return false;
    return true;
  });
}

/// The folder of "file:///path" or "file:/path", with %20 for a space.
std::string folder_of(const char* uri) {
  std::string text = uri ? uri : "";
  if (text.rfind("file://", 0) == 0)
    text.erase(0, 7);
  else if (text.rfind("file:", 0) == 0)
    text.erase(0, 5);
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      path += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
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

#if defined(_WIN32)
#define EXPORT extern "C" __declspec(dllexport)
#else
#define EXPORT extern "C" __attribute__((visibility("default")))
#endif

EXPORT const char* fmi2GetTypesPlatform() { return "default"; }
EXPORT const char* fmi2GetVersion() { return "2.0"; }
EXPORT int fmi2SetDebugLogging(void*, int, std::size_t, const char* const*) { return ok; }

EXPORT void* fmi2Instantiate(const char* name, int kind, const char*, const char* resources, const Callbacks* callbacks,
                             int, int) {
  try {
    auto made = std::make_unique<Component>();
    made->name = name ? name : "";
    if (callbacks) made->logger = callbacks->logger, made->environment = callbacks->environment;
    std::string text = kind == 1 ? "" : "this FMU is for co-simulation, not for model exchange";
    if (kind == 1) made->instance = Instance::make(folder_of(resources), text);
    if (made->instance) return made.release();
    if (made->logger) made->logger(made->environment, made->name.c_str(), error, "error", "%s", text.c_str());
  } catch (...) {
  }
  return nullptr;
}
EXPORT void fmi2FreeInstance(void* c) { delete static_cast<Component*>(c); }

EXPORT int fmi2SetupExperiment(void* c, int, double, double start, int, double) {
  return call(c, [&](Instance& instance) { return instance.start_at(start), true; });
}
EXPORT int fmi2EnterInitializationMode(void* c) { return c ? ok : error; }
EXPORT int fmi2ExitInitializationMode(void* c) {
  return call(c, [](Instance& instance) { return instance.begin(); });
}
EXPORT int fmi2Terminate(void* c) { return c ? ok : error; }
EXPORT int fmi2Reset(void* c) {
  return call(c, [](Instance& instance) { return instance.reset(); });
}

EXPORT int fmi2GetReal(void* c, const unsigned* references, std::size_t n, double* values) {
  return get_all(c, references, n, values);
}
EXPORT int fmi2GetInteger(void* c, const unsigned* references, std::size_t n, int* values) {
  return get_all(c, references, n, values);
}
EXPORT int fmi2GetBoolean(void* c, const unsigned* references, std::size_t n, int* values) {
  return get_all(c, references, n, values);
}
EXPORT int fmi2GetString(void*, const unsigned*, std::size_t n, const char**) { return n == 0 ? ok : error; }
EXPORT int fmi2SetReal(void* c, const unsigned* references, std::size_t n, const double* values) {
  return set_all(c, references, n, values);
}
EXPORT int fmi2SetInteger(void*, const unsigned*, std::size_t n, const int*) { return n == 0 ? ok : error; }
EXPORT int fmi2SetBoolean(void* c, const unsigned* references, std::size_t n, const int* values) {
  return set_all(c, references, n, values);
}
EXPORT int fmi2SetString(void*, const unsigned*, std::size_t n, const char* const*) { return n == 0 ? ok : error; }

EXPORT int fmi2SetRealInputDerivatives(void* c, const unsigned* references, std::size_t n, const int* orders,
                                       const double* values) {
  return call(c, [&](Instance& instance) {
    for (std::size_t i = 0; i < n; ++i)
      if (orders[i] != 1 || !instance.set_derivative(references[i], values[i])) return false;
    return true;
  });
}
EXPORT int fmi2GetRealOutputDerivatives(void*, const unsigned*, std::size_t, const int*, double*) { return error; }
EXPORT int fmi2GetDirectionalDerivative(void*, const unsigned*, std::size_t, const unsigned*, std::size_t,
                                        const double*, double*) {
  return error;
}

EXPORT int fmi2DoStep(void* c, double time, double duration, int) {
  return call(c, [&](Instance& instance) { return instance.step(time, duration); });
}
EXPORT int fmi2CancelStep(void*) { return error; }
EXPORT int fmi2GetStatus(void*, int, int*) { return discard; }
EXPORT int fmi2GetRealStatus(void* c, int kind, double* value) {
  if (!c || kind != 2) return discard;  // only the last successful time
  *value = component(c).instance->time();
  return ok;
}
EXPORT int fmi2GetIntegerStatus(void*, int, int*) { return discard; }
EXPORT int fmi2GetBooleanStatus(void* c, int kind, int* value) {
  if (!c || kind != 3) return discard;  // "terminated": never
  *value = 0;
  return ok;
}
EXPORT int fmi2GetStringStatus(void*, int, const char**) { return discard; }

EXPORT int fmi2GetFMUstate(void* c, void** state) {
  return call(c, [&](Instance& instance) {
    auto saved = instance.save();
    if (!saved) return false;
    if (*state)
      *static_cast<Saved*>(*state) = std::move(*saved);
    else
      *state = saved.release();
    return true;
  });
}
EXPORT int fmi2SetFMUstate(void* c, void* state) {
  return call(c, [&](Instance& instance) { return state && instance.restore(*static_cast<Saved*>(state)); });
}
EXPORT int fmi2FreeFMUstate(void*, void** state) {
  if (state) delete static_cast<Saved*>(std::exchange(*state, nullptr));
  return ok;
}
EXPORT int fmi2SerializedFMUstateSize(void*, void* state, std::size_t* size) {
  if (!state) return error;
  *size = static_cast<Saved*>(state)->size();
  return ok;
}
EXPORT int fmi2SerializeFMUstate(void*, void* state, char* bytes, std::size_t size) {
  if (!state || size < static_cast<Saved*>(state)->size()) return error;
  static_cast<Saved*>(state)->write(reinterpret_cast<unsigned char*>(bytes));
  return ok;
}
EXPORT int fmi2DeSerializeFMUstate(void* c, const char* bytes, std::size_t size, void** state) {
  return call(c, [&](Instance& instance) {
    auto saved = instance.read(reinterpret_cast<const unsigned char*>(bytes), size);
    if (!saved) return false;
    fmi2FreeFMUstate(c, state);
    *state = saved.release();
    return true;
  });
}
