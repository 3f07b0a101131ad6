// What the binding files share: one registering function a core folder, and how arrays come and go.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <initializer_list>
#include <memory>
#include <vector>

#include "punctura/model/validity.hpp"

namespace nb = nanobind;

namespace punctura::bindings {

void bind_model(nb::module_&);
void bind_proxy(nb::module_&);

/// A read-only view of somebody's float64 array; nanobind converts and copies only where type or layout differ.
using Input1d = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Input2d = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// Hands a buffer to NumPy without a copy.
template <typename T, std::size_t dimensions>
nb::ndarray<nb::numpy, T, nb::ndim<dimensions>> to_numpy(std::vector<T>&& buffer, std::array<std::size_t, dimensions> shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(buffer));
  T* data = owned->data();
  nb::capsule owner(owned.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return {data, dimensions, shape.data(), owner};
}

/// Throws punctura.ConfigurationError that carries every problem, if there is one.
void raise_if(const std::vector<Problem>& problems);

}  // namespace punctura::bindings
