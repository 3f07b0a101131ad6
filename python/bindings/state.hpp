// State of a stepping object as bytes: get, set, copy, pickle and peek.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>

#include "bindings.hpp"
#include "punctura/state/archive.hpp"

namespace punctura::bindings {

/// An object for one thread at a time. While `run` has released the GIL, no other thread may use the object.
class OneThread {
 public:
  OneThread() = default;
  OneThread(const OneThread&) noexcept {}  // a copy is another object
  OneThread& operator=(const OneThread&) noexcept { return *this; }

  /// Throws RuntimeError while run() is in progress.
  void must_rest() const {
    if (at_work_elsewhere())
      throw std::runtime_error(
          "run() is at work on this object in another thread: use it in one thread at a time, or "
          "give each thread a copy of its own");
    if (running_)
      throw std::runtime_error(
          "run() of this object is at work, and a progress function or a signal handler that it called used the "
          "object: run, copy or change it when run() has ended");
  }
  /// Whether run() is in progress in another thread. The thread of run() may read: it is then in `progress`, between
  /// two ticks.
  bool at_work_elsewhere() const { return running_ && std::this_thread::get_id() != runner_; }
  /// Throws RuntimeError while run() is in progress in another thread.
  void must_be_readable() const {
    if (at_work_elsewhere()) must_rest();
  }
  class Running {
   public:
    explicit Running(OneThread& object) : object_(object) {
      object.must_rest();
      object.running_ = true;
      object.runner_ = std::this_thread::get_id();
    }
    Running(const Running&) = delete;
    ~Running() { object_.running_ = false; }

   private:
    OneThread& object_;
  };

 private:
  bool running_ = false;  // changed and read with the GIL held; so is runner_
  std::thread::id runner_{};
};

/// Defines read-only properties. get: a member, or a function of the object. Those of a OneThread throw RuntimeError
/// while run() is in progress in another thread.
template <typename T>
struct Getters {
  nb::class_<T>& cls;

  template <typename Get, typename... Extra>
  const Getters& operator()(const char* name, const char* doc, Get get, const Extra&... extra) const {
    const auto read = [get](const T& self) {
      if constexpr (std::is_base_of_v<OneThread, T>) self.must_be_readable();
      return std::invoke(get, self);
    };
    cls.def_prop_ro(name, read, doc, extra...);
    return *this;
  }
};

inline nb::bytes as_bytes(const std::vector<std::byte>& state) { return nb::bytes(state.data(), state.size()); }
inline std::span<const std::byte> as_span(const nb::bytes& state) {
  return {static_cast<const std::byte*>(state.data()), state.size()};
}

/// Throws RuntimeError while run() of a OneThread is in progress.
template <typename T>
void must_rest(const T& object) {
  if constexpr (std::is_base_of_v<OneThread, T>) object.must_rest();
}

/// T has `reset()`.
template <typename T>
void def_reset(nb::class_<T>& cls, const char* doc = "Resets to the state before the first tick.") {
  cls.def(
      "reset",
      [](T& self) {
        must_rest(self);
        self.reset();
      },
      doc);
}

/// The state of a T that has `save()` and `load(bytes)`, or an archive.
template <typename T>
nb::bytes saved(const T& object) {
  must_rest(object);
  if constexpr (requires { object.save(); })
    return as_bytes(object.save());
  else
    return as_bytes(save_state(object));
}
template <typename T>
bool loaded(T& object, const nb::bytes& state) {
  must_rest(object);
  if constexpr (requires { object.load(as_span(state)); })
    return object.load(as_span(state));
  else
    return load_state(object, as_span(state));
}

/// Defines copies, pickling and `state`. arguments: gives the tuple of an object's constructor arguments.
template <typename T, typename Arguments>
void def_state(nb::class_<T>& cls, Arguments arguments) {
  const auto name = nb::cast<std::string>(cls.attr("__name__"));
  const std::string deepcopy = "def __deepcopy__(self, memo: dict[int, typing.Any]) -> " + name;
  const auto copy = [](const T& self) {
    must_rest(self);
    return T(self);
  };
  cls.def("__copy__", copy, "A copy with the same state. Both continue with identical results, bit for bit.")
      .def(
          "__deepcopy__", [copy](const T& self, const nb::dict&) { return copy(self); }, nb::arg("memo"),
          nb::sig(deepcopy.c_str()))
      .def(
          "__reduce__",
          [arguments](nb::handle self) {
            const auto& object = nb::cast<const T&>(self);
            const nb::bytes state = saved(object);
            return nb::make_tuple(nb::module_::import_("punctura.restore").attr("restored"),
                                  nb::make_tuple(self.type(), std::invoke(arguments, object), state));
          },
          nb::sig("def __reduce__(self) -> tuple[typing.Any, ...]"))
      .def_prop_rw(
          "state", &saved<T>,
          [name](T& self, const nb::bytes& state) {
            if (!loaded(self, state))
              throw value_error("these bytes are no state of this " + name +
                                ": they are damaged, or of other parameters, or of another version of punctura");
          },
          nb::for_getter(nb::sig("def state(self) -> bytes")),
          nb::for_setter(nb::sig("def state(self, state: bytes, /) -> None")),
          "The complete state as bytes. Setting it continues with identical results, bit for bit. Raises ValueError.");
}
template <typename T>
void def_state(nb::class_<T>& cls) {
  def_state(cls, &T::arguments);
}

}  // namespace punctura::bindings
