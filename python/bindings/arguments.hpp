// Constructors whose errors name the wrong argument, and warnings for numbers that are off by a factor of 1000.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"

namespace punctura::bindings {

/// "; did you mean friction?", or empty if no word is similar.
std::string nearest(const std::string& word, const nb::list& words);

inline constexpr const char* three_numbers = "Sequence[float]";  ///< in messages; a _Vector in the stub

struct Argument {
  const char* name;
  const char* type;        ///< in the notation of type hints
  nb::object otherwise{};  ///< default value; an argument without one is required
};

/// The values of a call's arguments, defaults included.
class Arguments {
 public:
  /// Throws TypeError for a missing, unknown, repeated or surplus argument, and suggests a similar name for an
  /// unknown one.
  Arguments(const std::string& call, const std::vector<Argument>& wanted, const nb::args& args,
            const nb::kwargs& kwargs);

  /// Throws TypeError that names the argument and its type if the value has another type.
  template <typename T>
  T get(std::size_t i) const {
    try {
      return nb::cast<T>(values_[i]);
    } catch (const nb::cast_error&) {
      refuse(i);
    }
  }

 private:
  [[noreturn]] void refuse(std::size_t i) const;
  [[noreturn]] void refuse(const std::string& faults) const;

  const std::string& call_;
  const std::vector<Argument>& wanted_;
  std::vector<nb::object> values_;
};

/// Defines the constructor of T. `make` gets the arguments in the order of `wanted`.
template <typename T, typename... A>
void def_init(nb::class_<T>& cls, std::vector<Argument> wanted, T (*make)(A...), const char* doc) {
  const auto name = nb::cast<std::string>(cls.attr("__name__"));
  std::string parameters;
  for (const Argument& a : wanted)
    parameters += std::string(", ") + a.name + ": " + (a.type == std::string(three_numbers) ? "_Vector" : a.type) +
                  (a.otherwise ? " = ..." : "");
  const std::string signature = "def __init__(self" + parameters + ") -> None";
  cls.def(
      "__init__",
      [name, wanted = std::move(wanted), make](T* self, const nb::args& args, const nb::kwargs& kwargs) {
        const Arguments given(name, wanted, args, kwargs);
        [&]<std::size_t... i>(std::index_sequence<i...>) {
          new (self) T(make(given.get<std::decay_t<A>>(i)...));
        }(std::index_sequence_for<A...>());
      },
      nb::sig(signature.c_str()), doc);
}

/// Emits a UserWarning if a number lies outside the usual range of its field in SI units, but inside it in mm, um, N/mm
/// or mN: that unit was most likely meant. path: "membrane.stiffness" or "membrane[0].stiffness".
void warn_unusual(const std::string& path, double value);

}  // namespace punctura::bindings
