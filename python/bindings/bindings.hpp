// Shared by the binding files: one registering function for each core folder, and the conversion of arrays.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "punctura/model/profile_law.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/model/thin_law.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/model/validity.hpp"
#include "punctura/model/vector3.hpp"

namespace nb = nanobind;

namespace punctura::bindings {
/// False for a complex and for a masked number. float() takes both from NumPy: it drops the imaginary part, and makes
/// NaN of a masked number.
bool is_real(nb::handle object) noexcept;

/// nanobind's errors copy a C string.
inline auto value_error(const std::string& text) { return nb::value_error(text.c_str()); }
inline auto type_error(const std::string& text) { return nb::type_error(text.c_str()); }

// Python types of arguments and results that C++ takes and gives as plain objects.
template <std::size_t n>
struct TypeText {
  char text[n];
  consteval TypeText(const char (&given)[n]) { std::copy_n(given, n, text); }
};
template <TypeText type>
struct Named {};
/// An object with this type in the signature. nanobind does not check it.
template <TypeText type>
using Object = nb::typed<nb::object, Named<type>>;

using ArrayLike = Object<"numpy.typing.ArrayLike">;
using Floats = Object<"numpy.typing.NDArray[numpy.float64]">;
using Columns = Object<"dict[str, numpy.typing.NDArray[typing.Any]]">;
using TicksObject = Object<"Ticks">;
using ProgressArgument = Object<"Progress">;
}  // namespace punctura::bindings

template <punctura::bindings::TypeText type>
struct nb::detail::type_caster<punctura::bindings::Named<type>> {
  static constexpr auto Name = const_name(type.text);
};

/// Every argument that is a number, alone or in a list. In place of nanobind's own conversion.
template <>
struct nb::detail::type_caster<double> {
  NB_TYPE_CASTER(double, const_name("float"))

  bool from_python(handle object, std::uint32_t flags, cleanup_list* cleanup) noexcept {
    return (PyFloat_Check(object.ptr()) || PyLong_Check(object.ptr()) || punctura::bindings::is_real(object)) &&
           NB_CALL(load_f64)(NB_CTX_C(cleanup), object.ptr(), flags, &value);
  }
  static handle from_cpp(double number, rv_policy, cleanup_list*) noexcept { return PyFloat_FromDouble(number); }
};

namespace punctura::bindings {

/// Defines what a file of this folder binds.
using Bind = void(nb::module_&);
Bind bind_model, bind_profile_law, bind_proxy, bind_syringe, bind_membrane, bind_tissue_law, bind_scene,
    bind_scene_keys, bind_insertion, bind_events, bind_trace, bind_plant, bind_experiment, bind_rivals, bind_fleet,
    bind_live_estimate, bind_limits, bind_tick_table, bind_thumb, bind_runtime, bind_python_devices, bind_devices,
    bind_replay, bind_batch, bind_scene_batch;
/// Makes the TypeErrors of all functions of the module name the wrong argument.
void explain_calls(nb::module_&);

/// A read-only view of an array. No copy is made if the array is float64 and contiguous.
using Input = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
/// A NumPy array of float64 or another type, of any strides, from anything that NumPy accepts as an array (a list,
/// another type, a slice). Throws TypeError for text, times and complex numbers, ValueError for rows of different
/// lengths and for masked elements, and MemoryError if a copy has no room; each names the argument.
nb::object real_numbers(const nb::object& array_like, const char* name, const char* type = "float64");
/// Throws MemoryError if so many bytes have no room on this computer. what: needs them.
void enough_memory(double bytes, const std::string& what, const char* advice);
/// The same, contiguous.
Input input(const nb::object& array_like, const char* name);
/// The same for shape (n,), or (n, 3) for points. Throws ValueError that names the argument.
Input input_1d(const nb::object& array_like, const char* name);
Input points(const nb::object& array_like, const char* name);
using Triple = std::array<double, 3>;
bool is_numpy_array(nb::handle object) noexcept;  ///< false for a subclass of numpy.ndarray

/// Passes a buffer to NumPy without a copy, in the given shape.
template <typename T>
nb::object to_numpy(std::vector<T>&& buffer, const std::vector<std::size_t>& shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(buffer));
  T* data = owned->data();
  nb::capsule owner(owned.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, T>(data, shape.size(), shape.data(), owner));
}

/// A NumPy array of one number of each row, of the given shape or (n,). get: a member of a row, or a function of it.
template <typename Row, typename Get>
nb::object column(const std::vector<Row>& rows, Get get, std::vector<std::size_t> shape = {}) {
  using Value = std::remove_cvref_t<std::invoke_result_t<Get, const Row&>>;
  using Number = std::conditional_t<std::is_enum_v<Value> || std::is_same_v<Value, bool>, std::uint8_t, Value>;
  std::vector<Number> numbers;
  numbers.reserve(rows.size());
  for (const Row& row : rows) numbers.push_back(static_cast<Number>(std::invoke(get, row)));
  if (shape.empty()) shape = {rows.size()};
  const nb::object array = to_numpy(std::move(numbers), shape);
  return std::is_same_v<Value, bool> ? array.attr("view")("bool") : array;
}

/// The rows of an (n, 3) array, or a (3,) array repeated for all n rows.
class Rows {
 public:
  /// Throws ValueError if the shape is neither (n, 3) nor (3,).
  Rows(Input array, std::size_t n, const char* name);
  Vector3d operator[](std::size_t i) const noexcept { return Vector3d(data_ + stride_ * i); }
  /// Throws ValueError if a row is not finite or has length 0.
  void check(const char* name) const;

 private:
  Input array_;
  const double* data_;
  std::size_t stride_;
};

/// The arguments of a law; the thin law reads two, the thick one has no tissue.
struct LawArguments {
  Needle needle;
  Membrane membrane;
  Tissue tissue{};
  double obliquity = 0;
};

/// A law that keeps the arguments of its constructor.
template <typename L>
struct LawOf : L, LawArguments {
  using Law = L;
  explicit LawOf(const LawArguments& a) : L(made(a)), LawArguments(a) {}

 private:
  static L made(const LawArguments& a) {
    if constexpr (std::is_same_v<L, ThinLaw>)
      return {a.needle, a.membrane};
    else if constexpr (std::is_same_v<L, ThickLaw>)
      return {a.needle, a.membrane, a.obliquity};
    else
      return {a.needle, a.membrane, a.tissue, std::cos(a.obliquity)};
  }
};
using GivenThinLaw = LawOf<ThinLaw>;
using GivenThickLaw = LawOf<ThickLaw>;
using GivenTissueLaw = LawOf<TissueLaw>;
struct GivenProfileLaw : ProfileLaw {
  using Law = ProfileLaw;
  std::vector<double> depth, lower, upper;
  double obliquity;
};
/// format: of Python's str.format, with the object as {0}: "<{0.__class__.__name__} of {0.scene.name!r}>".
template <typename T, typename... Options>
void def_repr(nb::class_<T, Options...>& cls, const char* format) {
  cls.def("__repr__", [format](nb::handle self) {
    const char* now = format;
    if constexpr (requires(const T& object) { object.at_work_elsewhere(); })
      if (nb::inst_ready(self) && nb::inst_ptr<T>(self)->at_work_elsewhere())
        now = "<{0.__class__.__name__}, at work in another thread>";
    return nb::str(nb::str(now).attr("format")(self));
  });
}

/// All problems of a needle, a membrane, and their combination.
std::vector<Problem> problems_of(const Needle& needle, const Membrane& membrane);
/// Adds a problem if the period of a tick (s) is not between 0 and 1 s.
void check_period(double period, std::vector<Problem>& problems);
/// Throws punctura.ConfigurationError if the rate of a device (Hz) is not one that a scene can have.
void check_rate(double rate);
/// Throws punctura.ConfigurationError with all problems, if there are any.
void raise_if(const std::vector<Problem>& problems);
/// The same for a word that is not allowed.
[[noreturn]] void raise_word(const std::string& path, const std::string& given, const char* reason);

/// The number of axes of a NumPy array or scalar; 0 for everything without `ndim`. Before NumPy 2.4, an array with one
/// element and any number of axes counts as a number.
inline long axes_of(nb::handle given) noexcept {
  PyObject* axes = PyObject_GetAttrString(given.ptr(), "ndim");
  const long n = axes ? PyLong_AsLong(axes) : 0;
  Py_XDECREF(axes);
  PyErr_Clear();
  return n;
}

/// Normalizes a direction of any length but 0. Throws ConfigurationError.
Vector3d unit(const Triple& direction, const std::string& path);

}  // namespace punctura::bindings

/// Three numbers. A NumPy vector is read at once, not element by element; stub_patterns.txt says what _Vector is.
template <>
struct nanobind::detail::type_caster<punctura::bindings::Triple>
    : nanobind::detail::array_caster<punctura::bindings::Triple, double, 3> {
  static constexpr auto Name = io_name("_Vector", "list[float]");

  bool from_python(handle from, std::uint32_t flags, cleanup_list* cleanup) noexcept {
    // Only a plain ndarray: the buffer of a subclass, such as a masked array, may not hold its element values.
    if (punctura::bindings::is_numpy_array(from)) {
      if (read_buffer(from.ptr())) return true;
      if (punctura::bindings::axes_of(from) != 1) return false;
    }
    if (PyBytes_Check(from.ptr()) || PyByteArray_Check(from.ptr()) || PyUnicode_Check(from.ptr())) return false;
    return array_caster::from_python(from, flags, cleanup);
  }

 private:
  /// Reads a buffer of three doubles. False for any other buffer.
  bool read_buffer(PyObject* from) noexcept {
    Py_buffer view;
    if (PyObject_GetBuffer(from, &view, PyBUF_FORMAT | PyBUF_STRIDES) != 0) {
      PyErr_Clear();
      return false;
    }
    const bool fits =
        view.ndim == 1 && view.shape[0] == 3 && view.format != nullptr && view.format[0] == 'd' && view.format[1] == 0;
    if (fits)
      for (std::size_t i = 0; i < 3; ++i)
        std::memcpy(&value[i], static_cast<const char*>(view.buf) + static_cast<std::ptrdiff_t>(i) * view.strides[0],
                    sizeof(double));
    PyBuffer_Release(&view);
    return fits;
  }
};

namespace punctura::bindings {

/// "; did you mean friction?", or empty if no word is similar.
std::string nearest(const std::string& word, const nb::list& words);

/// The whole number of an argument. Throws TypeError, and ValueError for one below `least` or above `most`.
std::size_t count_from(const nb::object& given, const char* name, std::size_t least, std::size_t most);
/// The argument `threads`: None or 0 is one for each processor.
std::size_t threads_from(const nb::object& given);

/// Defines the constructor of T: `make` with checks of its own. extra: nb::arg for each argument, and a doc.
template <typename T, typename... A, typename... Extra>
void def_init(nb::class_<T>& cls, T (*make)(A...), const Extra&... extra) {
  cls.def("__init__", [make](T* self, A... given) { new (self) T(make(std::forward<A>(given)...)); }, extra...);
}

/// Emits a UserWarning if a number lies outside the usual range of its field in SI units, but inside it in mm, um, N/mm
/// or mN: that unit was most likely meant. path: "membrane.stiffness" or "membrane[0].stiffness".
void warn_unusual(const std::string& path, double value);
/// The number of a list of a scene, such as "profile[].depth", that is farthest from 0, and what to write instead; or
/// nothing. Small numbers beside it are usual. size: of the unit of `written`, SI.
std::optional<std::pair<double, std::string>> unusual_list(std::string_view column, const std::vector<double>& written,
                                                           double size = 1);
/// Sets whether warn_unusual warns in this thread; it does at first. Returns the value before.
bool set_unusual_warnings(bool on);

}  // namespace punctura::bindings
