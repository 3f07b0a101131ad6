// The functions of FMI 3.0 for co-simulation, and what they need of its types. https://fmi-standard.org, version 3.0.2
#include <cstring>
#include <exception>
#include <utility>

#include "instance.hpp"

using punctura_fmi::Instance;
using punctura_fmi::Saved;

namespace {

enum Status : int { ok, warning, discard, error, fatal };
using Log = void (*)(void* environment, int status, const char* category, const char* message);

struct Component {
  std::unique_ptr<Instance> instance;
  Log log = nullptr;
  void* environment = nullptr;
};

/// Calls f(instance). Says why it failed. No exception crosses the border.
template <typename F>
int call(void* c, F&& f) noexcept {
  if (!c) return error;
  Component& all = *static_cast<Component*>(c);
  try {
    if (f(*all.instance)) return ok;
    if (all.log) all.log(all.environment, error, "error", all.instance->error().c_str());
  } catch (const std::exception& e) {
    if (all.log) all.log(all.environment, error, "error", e.what());
  }
  return error;
}

/// All variables are scalars: as many values as references.
template <typename To, typename Value>
int get_all(void* c, const std::uint32_t* references, std::size_t n, Value* values, std::size_t count) noexcept {
  if (n != count) return error;
  return call(c, [&](Instance& instance) {
    for (std::size_t i = 0; i < n; ++i) {
      To value{};
      if (!instance.get(references[i], value)) return false;
      values[i] = static_cast<Value>(value);
    }
    return true;
  });
}
template <typename To, typename Value>
int set_all(void* c, const std::uint32_t* references, std::size_t n, const Value* values, std::size_t count) noexcept {
  if (n != count) return error;
  return call(c, [&](Instance& instance) {
    for (std::size_t i = 0; i < n; ++i)
      if (!instance.set(references[i], static_cast<To>(values[i]))) return false;
    return true;
  });
}

}  // namespace

#if defined(_WIN32)
#define EXPORT extern "C" __declspec(dllexport)
#else
#define EXPORT extern "C" __attribute__((visibility("default")))
#endif

EXPORT const char* fmi3GetVersion() { return "3.0"; }
EXPORT int fmi3SetDebugLogging(void*, bool, std::size_t, const char* const*) { return ok; }

EXPORT void* fmi3InstantiateCoSimulation(const char*, const char*, const char* resources, bool, bool, bool, bool,
                                         const std::uint32_t*, std::size_t, void* environment, Log log, void*) {
  try {
    auto made = std::make_unique<Component>();
    made->log = log;
    made->environment = environment;
    std::string text;
    made->instance = Instance::make(resources ? resources : "", text);
    if (made->instance) return made.release();
    if (log) log(environment, error, "error", text.c_str());
  } catch (...) {
  }
  return nullptr;
}
EXPORT void* fmi3InstantiateModelExchange(const char*, const char*, const char*, bool, bool, void*, Log) {
  return nullptr;
}
EXPORT void* fmi3InstantiateScheduledExecution(const char*, const char*, const char*, bool, bool, void*, Log, void*,
                                               void*, void*) {
  return nullptr;
}
EXPORT void fmi3FreeInstance(void* c) { delete static_cast<Component*>(c); }

EXPORT int fmi3EnterInitializationMode(void* c, bool, double, double start, bool, double) {
  return call(c, [&](Instance& instance) { return instance.start_at(start), true; });
}
EXPORT int fmi3ExitInitializationMode(void* c) {
  return call(c, [](Instance& instance) { return instance.begin(); });
}
EXPORT int fmi3EnterStepMode(void* c) { return c ? ok : error; }
EXPORT int fmi3Terminate(void* c) { return c ? ok : error; }
EXPORT int fmi3Reset(void* c) {
  return call(c, [](Instance& instance) { return instance.reset(); });
}

EXPORT int fmi3GetFloat64(void* c, const std::uint32_t* references, std::size_t n, double* values, std::size_t count) {
  return get_all<double>(c, references, n, values, count);
}
EXPORT int fmi3SetFloat64(void* c, const std::uint32_t* references, std::size_t n, const double* values,
                          std::size_t count) {
  return set_all<double>(c, references, n, values, count);
}
EXPORT int fmi3GetInt32(void* c, const std::uint32_t* references, std::size_t n, std::int32_t* values,
                        std::size_t count) {
  return get_all<std::int32_t>(c, references, n, values, count);
}
EXPORT int fmi3GetBoolean(void* c, const std::uint32_t* references, std::size_t n, bool* values, std::size_t count) {
  return get_all<std::int32_t>(c, references, n, values, count);
}
EXPORT int fmi3SetBoolean(void* c, const std::uint32_t* references, std::size_t n, const bool* values,
                          std::size_t count) {
  return set_all<std::int32_t>(c, references, n, values, count);
}

EXPORT int fmi3DoStep(void* c, double time, double duration, bool, bool* event_needed, bool* terminate, bool* early,
                      double* last_time) {
  *event_needed = *terminate = *early = false;
  const int status = call(c, [&](Instance& instance) { return instance.step(time, duration); });
  if (c) *last_time = static_cast<Component*>(c)->instance->time();
  return status;
}

EXPORT int fmi3GetFMUState(void* c, void** state) {
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
EXPORT int fmi3SetFMUState(void* c, void* state) {
  return call(c, [&](Instance& instance) { return state && instance.restore(*static_cast<Saved*>(state)); });
}
EXPORT int fmi3FreeFMUState(void*, void** state) {
  if (state) delete static_cast<Saved*>(std::exchange(*state, nullptr));
  return ok;
}
EXPORT int fmi3SerializedFMUStateSize(void*, void* state, std::size_t* size) {
  if (!state) return error;
  *size = static_cast<Saved*>(state)->size();
  return ok;
}
EXPORT int fmi3SerializeFMUState(void*, void* state, std::uint8_t* bytes, std::size_t size) {
  if (!state || size < static_cast<Saved*>(state)->size()) return error;
  static_cast<Saved*>(state)->write(bytes);
  return ok;
}
EXPORT int fmi3DeserializeFMUState(void* c, const std::uint8_t* bytes, std::size_t size, void** state) {
  return call(c, [&](Instance& instance) {
    auto saved = instance.read(bytes, size);
    if (!saved) return false;
    fmi3FreeFMUState(c, state);
    *state = saved.release();
    return true;
  });
}

// The standard requires that every function exists. These have nothing to do here: there are no such variables, no
// events, no clocks and no derivatives. They read no argument.
#define REFUSED(name) \
  EXPORT int fmi3##name() { return error; }
REFUSED(EnterEventMode)
REFUSED(GetFloat32)
REFUSED(GetInt8)
REFUSED(GetUInt8)
REFUSED(GetInt16)
REFUSED(GetUInt16)
REFUSED(GetUInt32)
REFUSED(GetInt64)
REFUSED(GetUInt64)
REFUSED(GetString)
REFUSED(GetBinary)
REFUSED(GetClock)
REFUSED(SetFloat32)
REFUSED(SetInt8)
REFUSED(SetUInt8)
REFUSED(SetInt16)
REFUSED(SetUInt16)
REFUSED(SetInt32)
REFUSED(SetUInt32)
REFUSED(SetInt64)
REFUSED(SetUInt64)
REFUSED(SetString)
REFUSED(SetBinary)
REFUSED(SetClock)
REFUSED(GetNumberOfVariableDependencies)
REFUSED(GetVariableDependencies)
REFUSED(GetDirectionalDerivative)
REFUSED(GetAdjointDerivative)
REFUSED(EnterConfigurationMode)
REFUSED(ExitConfigurationMode)
REFUSED(GetIntervalDecimal)
REFUSED(GetIntervalFraction)
REFUSED(GetShiftDecimal)
REFUSED(GetShiftFraction)
REFUSED(SetIntervalDecimal)
REFUSED(SetIntervalFraction)
REFUSED(SetShiftDecimal)
REFUSED(SetShiftFraction)
REFUSED(EvaluateDiscreteStates)
REFUSED(UpdateDiscreteStates)
REFUSED(EnterContinuousTimeMode)
REFUSED(CompletedIntegratorStep)
REFUSED(SetTime)
REFUSED(SetContinuousStates)
REFUSED(GetContinuousStateDerivatives)
REFUSED(GetEventIndicators)
REFUSED(GetContinuousStates)
REFUSED(GetNominalsOfContinuousStates)
REFUSED(GetNumberOfEventIndicators)
REFUSED(GetNumberOfContinuousStates)
REFUSED(GetOutputDerivatives)
REFUSED(ActivateModelPartition)
