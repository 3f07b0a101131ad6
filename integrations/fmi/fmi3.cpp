// The functions of FMI 3.0 for co-simulation, and what they need of its types. https://fmi-standard.org, version 3.0.2
#include <limits>

#include "component.hpp"

using namespace punctura_fmi;

namespace {

using Log = void (*)(void* environment, int status, const char* category, const char* message);

struct Component3 final : Component {
  void log(const char* text) const noexcept override {
    if (logger) logger(environment, error, "error", text);
  }
  Log logger = nullptr;
  void* environment = nullptr;
};

void* instance_in(const char* resources, void* environment, Log log, const char* refused) noexcept {
  try {
    auto made = std::make_unique<Component3>();
    made->logger = log;
    made->environment = environment;
    return instantiate(std::move(made), resources ? resources : "", refused);
  } catch (...) {
    return nullptr;
  }
}
constexpr const char* only_steps = "this FMU is for co-simulation only";

}  // namespace

EXPORT const char* fmi3GetVersion() { return "3.0"; }
EXPORT int fmi3SetDebugLogging(void*, bool, std::size_t, const char* const*) { return ok; }

EXPORT void* fmi3InstantiateCoSimulation(const char*, const char*, const char* resources, bool, bool, bool events, bool,
                                         const std::uint32_t*, std::size_t, void* environment, Log log, void*) {
  return instance_in(resources, environment, log, events ? "eventModeUsed: this FMU has no event mode" : "");
}
EXPORT void* fmi3InstantiateModelExchange(const char*, const char*, const char* resources, bool, bool,
                                          void* environment, Log log) {
  return instance_in(resources, environment, log, only_steps);
}
EXPORT void* fmi3InstantiateScheduledExecution(const char*, const char*, const char* resources, bool, bool,
                                               void* environment, Log log, void*, void*, void*) {
  return instance_in(resources, environment, log, only_steps);
}
EXPORT void fmi3FreeInstance(void* c) { delete static_cast<Component*>(c); }

EXPORT int fmi3EnterInitializationMode(void* c, bool, double, double start, bool has_stop, double stop) {
  return call(c, Call::enter, __func__, [&](Instance& instance) {
    return instance.set_times(start, has_stop ? stop : std::numeric_limits<double>::infinity());
  });
}
EXPORT int fmi3ExitInitializationMode(void* c) {
  return call(c, Call::leave, __func__, [](Instance& instance) { return instance.begin(); });
}
EXPORT int fmi3Terminate(void* c) {
  return call(c, Call::terminate, __func__, [](Instance&) { return true; });
}
EXPORT int fmi3Reset(void* c) {
  return call(c, Call::reset, __func__, [](Instance& instance) { return instance.reset(); });
}

EXPORT int fmi3GetFloat64(void* c, const std::uint32_t* references, std::size_t n, double* values, std::size_t count) {
  return get_all(c, __func__, Kind::real, references, n, values, count);
}
EXPORT int fmi3SetFloat64(void* c, const std::uint32_t* references, std::size_t n, const double* values,
                          std::size_t count) {
  return set_all(c, __func__, Kind::real, references, n, values, count);
}
EXPORT int fmi3GetInt32(void* c, const std::uint32_t* references, std::size_t n, std::int32_t* values,
                        std::size_t count) {
  return get_all(c, __func__, Kind::integer, references, n, values, count);
}
EXPORT int fmi3GetBoolean(void* c, const std::uint32_t* references, std::size_t n, bool* values, std::size_t count) {
  return get_all(c, __func__, Kind::boolean, references, n, values, count);
}
EXPORT int fmi3SetBoolean(void* c, const std::uint32_t* references, std::size_t n, const bool* values,
                          std::size_t count) {
  return set_all(c, __func__, Kind::boolean, references, n, values, count);
}

EXPORT int fmi3DoStep(void* c, double time, double duration, bool, bool* event_needed, bool* terminate, bool* early,
                      double* last_time) {
  *event_needed = *terminate = *early = false;
  const int status = call(c, Call::step, __func__, [&](Instance& instance) { return instance.step(time, duration); });
  if (c) *last_time = static_cast<Component*>(c)->instance->time();
  return status;
}

EXPORT int fmi3GetFMUState(void* c, void** state) { return get_state(c, __func__, state); }
EXPORT int fmi3SetFMUState(void* c, void* state) { return set_state(c, __func__, state); }
EXPORT int fmi3FreeFMUState(void*, void** state) { return free_state(state); }
EXPORT int fmi3SerializedFMUStateSize(void* c, void* state, std::size_t* size) {
  return state_size(c, __func__, state, size);
}
EXPORT int fmi3SerializeFMUState(void* c, void* state, std::uint8_t* bytes, std::size_t size) {
  return serialize(c, __func__, state, bytes, size);
}
EXPORT int fmi3DeserializeFMUState(void* c, const std::uint8_t* bytes, std::size_t size, void** state) {
  return deserialize(c, __func__, bytes, size, state);
}

// The standard requires that every function exists. These have nothing to do here: there are no such variables, no
// events, no clocks and no derivatives. They read no argument but the instance.
#define REFUSED(name) \
  EXPORT int fmi3##name(void* c) { return refuse(c, "fmi3" #name); }
REFUSED(EnterStepMode)
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
