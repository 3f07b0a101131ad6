// What fmi2.cpp and fmi3.cpp share: each call looks into the table, reports why it failed, and lets no exception out.
#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "instance.hpp"

#if defined(_WIN32)
#define EXPORT extern "C" __declspec(dllexport)
#else
#define EXPORT extern "C" __attribute__((visibility("default")))
#endif

namespace punctura_fmi {

enum Status : int { ok, warning, discard, error, fatal, pending };

/// An instance and the simulator's logger.
struct Component {
  virtual ~Component() = default;
  virtual void log(const char* text) const noexcept = 0;

  std::unique_ptr<Instance> instance;
};

/// Gives `made` an instance of the FMU in a folder. Returns nullptr, after a report, if `refused` or the scene say why.
template <typename Made>
void* instantiate(std::unique_ptr<Made> made, const std::string& resources, std::string refused) {
  try {
    if (refused.empty()) made->instance = Instance::make(resources, refused);
  } catch (const std::exception& e) {  // on Windows also of a folder that is not UTF-8
    refused = e.what();
  }
  if (made->instance) return static_cast<Component*>(made.release());
  made->log(refused.c_str());
  return nullptr;
}

/// Calls f(instance), which returns whether it could.
template <typename F>
int call(void* c, Call kind, const char* function, F&& f) noexcept {
  if (!c) return error;
  Component& all = *static_cast<Component*>(c);
  try {
    const Rule& rule = rule_of(kind);
    const std::string wrong = out_of_order(rule, all.instance->state(), function);
    if (wrong.empty() && f(*all.instance)) {
      if (rule.moves) all.instance->move_to(rule.next);
      return ok;
    }
    all.log(wrong.empty() ? (std::string(function) + ": " + all.instance->error()).c_str() : wrong.c_str());
  } catch (const std::exception& e) {
    all.log(e.what());
  }
  return error;
}

/// A function that can do nothing here.
inline int refuse(void* c, const char* function) noexcept {
  return call(c, Call::state, function,
              [](Instance& instance) { return instance.fail("this FMU has no such variables, modes or derivatives"); });
}

/// All variables are scalars: as many values as references.
template <typename Value>
int get_all(void* c, const char* function, Kind kind, const std::uint32_t* references, std::size_t n, Value* values,
            std::size_t count) noexcept {
  return call(c, Call::get, function, [&](Instance& instance) {
    if (n != count) return instance.fail("the numbers of references and values differ: all variables are scalars");
    for (std::size_t i = 0; i < n; ++i) {
      double value = 0;
      if (!instance.get(references[i], kind, value)) return false;
      values[i] = static_cast<Value>(value);
    }
    return true;
  });
}
template <typename Value>
int set_all(void* c, const char* function, Kind kind, const std::uint32_t* references, std::size_t n,
            const Value* values, std::size_t count) noexcept {
  return call(c, Call::set, function, [&](Instance& instance) {
    if (n != count) return instance.fail("the numbers of references and values differ: all variables are scalars");
    for (std::size_t i = 0; i < n; ++i)
      if (!instance.settable(references[i], kind)) return false;
    for (std::size_t i = 0; i < n; ++i) instance.set(references[i], static_cast<double>(values[i]));
    return true;
  });
}

inline int get_state(void* c, const char* function, void** state) noexcept {
  return call(c, Call::state, function, [&](Instance& instance) {
    auto saved = instance.save();
    if (*state)
      *static_cast<Saved*>(*state) = std::move(*saved);
    else
      *state = saved.release();
    return true;
  });
}
inline int set_state(void* c, const char* function, void* state) noexcept {
  return call(c, Call::state, function, [&](Instance& instance) {
    return state ? instance.restore(*static_cast<Saved*>(state)) : instance.fail("the state is NULL");
  });
}
inline int free_state(void** state) noexcept {
  if (state) delete static_cast<Saved*>(std::exchange(*state, nullptr));
  return ok;
}
inline int state_size(void* c, const char* function, void* state, std::size_t* size) noexcept {
  return call(c, Call::state, function, [&](Instance& instance) {
    if (!state) return instance.fail("the state is NULL");
    *size = static_cast<Saved*>(state)->size();
    return true;
  });
}
inline int serialize(void* c, const char* function, void* state, void* bytes, std::size_t size) noexcept {
  return call(c, Call::state, function, [&](Instance& instance) {
    if (!state) return instance.fail("the state is NULL");
    const Saved& saved = *static_cast<Saved*>(state);
    if (size < saved.size()) return instance.fail("the state needs " + std::to_string(saved.size()) + " bytes");
    saved.write(static_cast<unsigned char*>(bytes));
    return true;
  });
}
inline int deserialize(void* c, const char* function, const void* bytes, std::size_t size, void** state) noexcept {
  return call(c, Call::state, function, [&](Instance& instance) {
    auto saved = instance.read(static_cast<const unsigned char*>(bytes), size);
    if (!saved) return false;
    free_state(state);
    *state = saved.release();
    return true;
  });
}

}  // namespace punctura_fmi
