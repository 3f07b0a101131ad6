// Constructors that name the argument which does not fit. And numbers that are off by a factor of 1000.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"

namespace punctura::bindings {

/// "; did you mean friction?", or nothing where no word is near.
std::string nearest(const std::string& word, const nb::list& words);

inline constexpr const char* three_numbers = "Sequence[float]";  ///< in messages; a _Vector in the stub

struct Argument {
  const char* name;
  const char* type;        ///< as a type checker writes it
  nb::object otherwise{};  ///< its default; without one it is required
};

/// What a call has given for the arguments that it takes, defaults filled in.
class Arguments {
 public:
  /// Throws TypeError for an argument that is missing, unknown, given twice, or one too many; an unknown one with the word that was most
  /// likely meant.
  Arguments(const std::string& call, const std::vector<Argument>& wanted, const nb::args& args,
            const nb::kwargs& kwargs);

  /// Throws TypeError that names the argument and its type, where it does not fit.
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

/// The constructor of T: `make` gets the arguments in the order of `wanted`.
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

/// Warns (UserWarning) where a number in SI units lies outside the range in which one finds that field in practice, and the same number in
/// mm, N/mm or mN would lie inside: that unit was most likely meant. path: "membrane.stiffness" or "membrane[0].stiffness".
void warn_unusual(const std::string& path, double value);

}  // namespace punctura::bindings
