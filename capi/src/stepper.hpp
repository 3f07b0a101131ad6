// What all steps behind the C ABI have in common: peek and commit, save and restore.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "common.hpp"
#include "punctura/servo/snapshot.hpp"
#include "punctura/state/archive.hpp"

namespace punctura::c {

/// An object with a step, and the same object one tick later while a peek is pending.
///
/// A peek copies the object. Both copies have their memory from the start, so that a peek allocates none.
template <typename Object>
struct Stepper {
  explicit Stepper(Object object) : now(std::move(object)), next(now), state_size(save_state(now).size()) {}

  Object now, next;
  std::size_t state_size;
  bool peeked = false;

  /// The object for a tick that counts at once.
  Object& stepping() noexcept {
    peeked = false;
    return now;
  }
  /// The object for a tick that does not count until commit().
  Object& peeking() noexcept {
    peeked = true;
    next = now;
    return next;
  }
  punctura_status commit() noexcept {
    if (!peeked) return PUNCTURA_NO_PEEK;
    std::swap(now, next);
    peeked = false;
    return ok;
  }
};

template <typename S>
std::size_t state_size(const S* stepper) noexcept {
  return stepper ? stepper->state_size : 0;
}

template <typename S>
punctura_status save(const S* stepper, void* state, std::size_t size) {
  return guarded({stepper, state}, [&] {
    if (size < stepper->state_size)
      return fail(PUNCTURA_BAD_ARGUMENT, "the buffer has " + std::to_string(size) + " bytes; the state needs " +
                                             std::to_string(stepper->state_size));
    const auto bytes = save_state(stepper->now);
    std::memcpy(state, bytes.data(), bytes.size());
    return ok;
  });
}

template <typename S>
punctura_status restore(S* stepper, const void* state, std::size_t size) {
  return guarded({stepper, state}, [&] {
    if (size != stepper->state_size)
      return fail(PUNCTURA_BAD_STATE, "the state has " + std::to_string(size) + " bytes; this object's state has " +
                                          std::to_string(stepper->state_size));
    if (!load_state(stepper->now, std::span(static_cast<const std::byte*>(state), size)))
      return fail(PUNCTURA_BAD_STATE,
                  "the bytes are damaged, or they are the state of another scene or of another version");
    stepper->peeked = false;
    return ok;
  });
}

/// Makes a handle with `make()`, which returns a unique_ptr, empty after it has kept an error.
template <typename Handle, typename Make>
punctura_status make_handle(const punctura_scene* scene, Handle** handle, Make&& make) {
  return guarded({scene, handle}, [&] {
    std::unique_ptr<Handle> made;
    const punctura_status status = make(made);
    if (status == ok) *handle = made.release();
    return status;
  });
}

inline punctura_status give_membrane(punctura_membrane_tick* to, const MembraneRecord& m) noexcept {
  if (!known_size(to)) return PUNCTURA_BAD_ARGUMENT;
  const auto& q = m.proxy;
  const auto& b = m.direction;
  give(to, {sizeof *to,
            static_cast<int32_t>(m.phase),
            m.depth,
            m.axial_force,
            m.lower,
            m.upper,
            {q[0], q[1], q[2]},
            {b[0], b[1], b[2]}});
  return ok;
}

inline Vector3d vector(const double v[3]) noexcept { return {v[0], v[1], v[2]}; }

/// Writes a force. Returns PUNCTURA_NO_NUMBER if it is NaN.
inline punctura_status give_force(const Vector3d& from, double to[3]) noexcept {
  for (std::size_t i = 0; i < 3; ++i) to[i] = from[i];
  return from.allFinite() ? ok : PUNCTURA_NO_NUMBER;
}

inline punctura_status no_force(double force[3], punctura_status status = PUNCTURA_BAD_ARGUMENT) noexcept {
  if (force) force[0] = force[1] = force[2] = not_given;
  return status;
}

/// One tick of an insertion or a proxy in space.
template <typename Object>
punctura_status step_in_space(Object& object, const double position[3], const double axis[3],
                              double force[3]) noexcept {
  const Vector3d direction = vector(axis).stableNormalized();
  bool reads_axis = true;
  if constexpr (requires { object.uses_axis(); }) reads_axis = object.uses_axis();
  if (reads_axis && direction == Vector3d()) return no_force(force, PUNCTURA_NO_NUMBER);
  return give_force(object.step(vector(position), direction), force);
}

}  // namespace punctura::c

// A stepper, and the functions of punctura.h that all of them have. A name of C needs a macro.
#define PUNCTURA_CALL(name, call)                                    \
  punctura_status punctura_##name##_##call(punctura_##name* given) { \
    if (!given) return PUNCTURA_BAD_ARGUMENT;                        \
    given->stepping().call();                                        \
    return ok;                                                       \
  }
#define PUNCTURA_STEPPER(name, Object)                                                                \
  struct punctura_##name : Stepper<Object> {                                                          \
    using Stepper::Stepper;                                                                           \
  };                                                                                                  \
  void punctura_##name##_free(punctura_##name* given) { delete given; }                               \
  PUNCTURA_CALL(name, reset)                                                                          \
  punctura_status punctura_##name##_commit(punctura_##name* given) {                                  \
    return given ? given->commit() : PUNCTURA_BAD_ARGUMENT;                                           \
  }                                                                                                   \
  size_t punctura_##name##_state_size(const punctura_##name* given) { return state_size(given); }     \
  punctura_status punctura_##name##_save(const punctura_##name* given, void* state, size_t size) {    \
    return save(given, state, size);                                                                  \
  }                                                                                                   \
  punctura_status punctura_##name##_restore(punctura_##name* given, const void* state, size_t size) { \
    return restore(given, state, size);                                                               \
  }

#define PUNCTURA_STEP_IN_SPACE(name, call, object)                                                                 \
  punctura_status punctura_##name##_##call(punctura_##name* given, const double position[3], const double axis[3], \
                                           double force[3]) {                                                      \
    if (!given || !position || !axis || !force) return no_force(force);                                            \
    return step_in_space(given->object(), position, axis, force);                                                  \
  }
#define PUNCTURA_STEPS_IN_SPACE(name)          \
  PUNCTURA_STEP_IN_SPACE(name, step, stepping) \
  PUNCTURA_STEP_IN_SPACE(name, peek, peeking)
