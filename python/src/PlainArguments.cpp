// Calls that a function does not take, told in a sentence instead of a list of signatures.
#include "PlainArguments.hpp"

namespace ortung::python {
namespace {

/// pybind11's own way into all of its functions.
struct Dispatch : py::cpp_function {
  static constexpr PyCFunctionWithKeywords kCall = &Dispatch::dispatcher;
};

/// Puts the sentence in the place of pybind11's error. What goes wrong meanwhile leaves the error
/// as it was.
void explain(PyObject* args, PyObject* kwargs) {
  py::error_already_set raised;
  try {
    const auto given = py::reinterpret_borrow<py::object>(args);
    const py::object named =
        kwargs == nullptr ? py::dict() : py::reinterpret_borrow<py::object>(kwargs);
    const py::object told =
        py::module_::import("ortung._arguments").attr("told")(raised.value(), given, named);
    PyErr_SetObject(PyExc_TypeError, told.ptr());
  } catch (const py::error_already_set&) {
    raised.restore();
  }
}

PyObject* callPlainly(PyObject* self, PyObject* args, PyObject* kwargs) {
  PyObject* const result = Dispatch::kCall(self, args, kwargs);
  if (result == nullptr && PyErr_ExceptionMatches(PyExc_TypeError) != 0) explain(args, kwargs);
  return result;
}

PyCFunction asFunction(PyCFunctionWithKeywords call) {
  return reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(call));
}

/// Puts callPlainly() before a bound function. All else, such as its help, stays; what is none of
/// pybind11's functions stays as well.
void speakPlainlyIn(PyObject* member) {
  if (PyInstanceMethod_Check(member)) member = PyInstanceMethod_GET_FUNCTION(member);
  if (PyCFunction_Check(member) == 0) return;
  PyMethodDef* const definition = reinterpret_cast<PyCFunctionObject*>(member)->m_ml;
  if (definition->ml_meth == asFunction(Dispatch::kCall))
    definition->ml_meth = asFunction(&callPlainly);
}

}  // namespace

void speakPlainly(const py::module_& module) {
  for (const auto& [name, member] : py::cast<py::dict>(module.attr("__dict__"))) {
    speakPlainlyIn(member.ptr());
    if (PyType_Check(member.ptr()) == 0) continue;
    for (const auto& [key, one] : py::dict(member.attr("__dict__"))) speakPlainlyIn(one.ptr());
  }
}

}  // namespace ortung::python
