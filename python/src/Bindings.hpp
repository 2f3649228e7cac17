#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung::python {

namespace py = pybind11;

void bindLearning(py::module_& module);
void bindContainer(py::module_& module);
void bindRobots(py::module_& module);
void bindLocalization(py::module_& module);
void bindRecords(py::module_& module);
void bindEvaluation(py::module_& module);
void bindWorlds(py::module_& module);
void bindLearner(py::module_& module);
void bindSimulations(py::module_& module);

/// A view that is to be read only.
inline py::array readOnly(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}
template <class T>
py::array copyOf(const std::vector<T>& numbers) {
  return py::array(py::dtype::of<T>(), static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// A table of numbers. @param row of an index, gives its columns
template <class Row>
py::array tableOf(py::ssize_t rows, py::ssize_t columns, const Row& row) {
  py::array_t<double> all({rows, columns});
  double* out = all.mutable_data();
  for (py::ssize_t i = 0; i < rows; ++i)
    for (const double value : row(i)) *out++ = value;
  return all;
}

/// x, x, y, y of a grid's edges [m], as pictures want it.
inline py::tuple extentOf(const FieldGrid& grid) {
  return py::make_tuple(grid.originX, grid.originX + grid.columns * grid.cell, grid.originY,
                        grid.originY + grid.rows * grid.cell);
}

/// A pose as three numbers.
inline py::tuple tupleOf(const Pose2& pose) { return py::make_tuple(pose.x, pose.y, pose.theta); }

/// What Python prints of an object.
inline std::string textOf(const py::handle& object) {
  return py::cast<std::string>(py::str(object));
}

/// Real numbers of any type as an array of T; complex ones and flags would lose what they are.
/// @param what names them in errors @throws py::type_error
template <class T>
py::array_t<T, py::array::c_style | py::array::forcecast> realNumbers(const py::handle& numbers,
                                                                      const std::string& what) {
  const auto array = py::module_::import("numpy").attr("asarray")(numbers);
  const auto dtype = py::cast<py::array>(array).dtype();
  if (std::string_view("fiu").find(dtype.kind()) == std::string_view::npos)
    throw py::type_error(what + " are of " + textOf(dtype) + ", expected real numbers");
  return array;
}

}  // namespace ortung::python
