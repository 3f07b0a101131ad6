// What the binding files share: one registering function a core folder, and how arrays come and go.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "punctura/model/thick_law.hpp"
#include "punctura/model/thin_law.hpp"
#include "punctura/model/validity.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/proxy/solver.hpp"

namespace nb = nanobind;

namespace punctura::bindings {

void bind_model(nb::module_&);
void bind_proxy(nb::module_&);
void bind_scene(nb::module_&);
void bind_insertion(nb::module_&);
void bind_events(nb::module_&);
void bind_plant(nb::module_&);
void bind_experiment(nb::module_&);
void bind_limits(nb::module_&);
void bind_tick_table(nb::module_&);
void bind_runtime(nb::module_&);
void bind_given_devices(nb::module_&);
void bind_devices(nb::module_&);
void bind_replay(nb::module_&);

/// A read-only view of numbers in memory: somebody's own array, without a copy, where it is float64 and contiguous.
using Input = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
/// The view of anything NumPy takes for an array: a list, another type, a slice. Throws what NumPy throws.
Input input(const nb::object& array_like);
/// The same, (n,) or (n, 3) only. Throws ValueError that names the argument.
Input input_1d(const nb::object& array_like, const char* name);
Input points(const nb::object& array_like, const char* name);
using Triple = std::array<double, 3>;

/// Three numbers of one call. A NumPy vector is read at once, not element by element.
struct Point {
  Triple numbers;
  Vector3d to_vector() const noexcept { return Vector3d(numbers); }
};

/// Hands a buffer to NumPy without a copy, in the shape given.
template <typename T>
nb::object to_numpy(std::vector<T>&& buffer, const std::vector<std::size_t>& shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(buffer));
  T* data = owned->data();
  nb::capsule owner(owned.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, T>(data, shape.size(), shape.data(), owner));
}

/// Row i of an (n, 3) array, or of a (3,) array that stands for all rows.
class Rows {
 public:
  /// Throws ValueError where the shape is neither (n, 3) nor (3,).
  Rows(Input array, std::size_t n, const char* name);
  Vector3d operator[](std::size_t i) const noexcept { return Vector3d(data_ + stride_ * i); }
  /// Throws ValueError where a row is not finite or has no length.
  void check(const char* name) const;

 private:
  Input array_;
  const double* data_;
  std::size_t stride_;
};

/// Laws that know what they were made of.
struct GivenThinLaw : ThinLaw {
  Needle needle;
  Membrane membrane;
};
struct GivenThickLaw : ThickLaw {
  Needle needle;
  Membrane membrane;
  double obliquity;
};

/// Every bound that a needle, a membrane or the pair of them breaks.
std::vector<Problem> problems_of(const Needle& needle, const Membrane& membrane);
/// Throws punctura.ConfigurationError that carries every problem, if there is one.
void raise_if(const std::vector<Problem>& problems);
/// The same for a word that is not one of those allowed.
[[noreturn]] void raise_word(const std::string& path, const std::string& given, const char* reason);

/// "exact" or "paper" to Solver and back. Throws ConfigurationError for another word.
Solver solver_from(const std::string& name, const std::string& path = "solver");
std::string name_of(Solver solver);

/// A direction of any length but 0 as a unit vector. Throws ConfigurationError.
Vector3d unit(const Triple& direction, const std::string& path);

}  // namespace punctura::bindings

template <>
struct nanobind::detail::type_caster<punctura::bindings::Point> {
  NB_TYPE_CASTER(punctura::bindings::Point,
                 const_name("Sequence[float] | numpy.typing.NDArray[numpy.floating | numpy.integer]"))

  bool from_python(handle from, std::uint8_t flags, cleanup_list* cleanup) noexcept {
    // Of other types, as a masked array, only the elements say what they are.
    if (std::strcmp(Py_TYPE(from.ptr())->tp_name, "numpy.ndarray") == 0 && read_buffer(from.ptr())) return true;
    if (PyBytes_Check(from.ptr()) || PyByteArray_Check(from.ptr()) || PyUnicode_Check(from.ptr())) return false;
    make_caster<punctura::bindings::Triple> triple;
    if (!triple.from_python(from, flags, cleanup)) return false;
    value.numbers = triple.value;
    return true;
  }

 private:
  /// Of three doubles in a row.
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
        std::memcpy(&value.numbers[i],
                    static_cast<const char*>(view.buf) + static_cast<std::ptrdiff_t>(i) * view.strides[0],
                    sizeof(double));
    PyBuffer_Release(&view);
    return fits;
  }
};
