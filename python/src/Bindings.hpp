#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <span>
#include <vector>

namespace ortung::python {

namespace py = pybind11;

void bindLearning(py::module_& module);
void bindContainer(py::module_& module);
void bindRobots(py::module_& module);
void bindLocalization(py::module_& module);

/// The numbers themselves, not a copy. @param owner what they live in
template <class T, class Element = T>
py::array viewOf(std::span<const Element> numbers, std::vector<py::ssize_t> shape,
                 const py::handle& owner) {
  static_assert(sizeof(T) == sizeof(Element));
  return py::array(py::dtype::of<T>(), std::move(shape), numbers.data(), owner);
}
/// The same, to be read only.
inline py::array readOnly(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}
template <class T>
py::array copyOf(const std::vector<T>& numbers) {
  return py::array(py::dtype::of<T>(), static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

}  // namespace ortung::python
