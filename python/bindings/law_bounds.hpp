// The band of a law in Python, at one depth or at many.
#pragma once

#include <utility>
#include <vector>

#include "bindings.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {

/// Lower and upper edge of the band for an array of depths of any shape.
template <typename L>
nb::tuple bounds(const L& law, const nb::object& depths) {
  const Input depth = input(depths, "depth");
  const std::size_t n = depth.size();
  std::vector<double> lower(n), upper(n);
  {
    const WithoutLock release;
    for (std::size_t i = 0; i < n; ++i) {
      const auto band = law.band(depth.data()[i]);
      lower[i] = band.lower;
      upper[i] = band.upper;
    }
  }
  const std::vector<std::size_t> shape(depth.shape_ptr(), depth.shape_ptr() + depth.ndim());
  return nb::make_tuple(to_numpy(std::move(lower), shape), to_numpy(std::move(upper), shape));
}

/// Python's numbers, NumPy's, and arrays without a dimension.
inline bool is_one_number(const nb::object& value) {
  if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr())) return true;
  return nb::hasattr(value, "ndim") && nb::cast<int>(value.attr("ndim")) == 0;
}

template <typename L>
void def_bounds(nb::class_<L>& law) {
  law.def(
         "bounds",
         [](const L& l, const nb::object& q) {
           if (!is_one_number(q)) throw nb::next_overload();
           const auto b = l.band(nb::cast<double>(nb::float_(q)));
           return nb::make_tuple(b.lower, b.upper);
         },
         nb::arg("depth"),
         nb::sig("def bounds(self, depth: float | numpy.floating | numpy.integer) -> tuple[float, float]"),
         "The band of static friction at one depth (m, along the needle): (lower, upper), N.")
      .def("bounds", &bounds<L>, nb::arg("depth"),
           nb::sig("def bounds(self, depth: numpy.typing.ArrayLike) -> tuple[numpy.typing.NDArray[numpy.float64], "
                   "numpy.typing.NDArray[numpy.float64]]"),
           "The same for an array of depths of any shape. Returns (lower, upper) of that shape, N.");
}

}  // namespace punctura::bindings
