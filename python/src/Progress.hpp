#pragma once

#include <chrono>
#include <exception>

#include "Bindings.hpp"

namespace ortung::python {

/// Tells a function of Python how far long work is, some ten times a second, and lets Python handle
/// signals: Ctrl-C ends the work. The work has no lock of Python.
class ProgressTeller {
 public:
  /// @param progress takes a share, or None
  explicit ProgressTeller(const py::object& progress) : progress_(progress) {}

  /// Returns whether to go on.
  bool tell(double share) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return true;
    constexpr std::chrono::milliseconds kBetween{100};
    next_ = now + kBetween;
    const py::gil_scoped_acquire python;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress_.is_none()) progress_(share);
    } catch (const py::error_already_set&) {
      why_ = std::current_exception();
    }
    return why_ == nullptr;
  }
  /// Raises what ended the work.
  void raiseIfStopped() const {
    if (why_) std::rethrow_exception(why_);
  }

 private:
  py::object progress_;
  std::chrono::steady_clock::time_point next_;
  std::exception_ptr why_;
};

}  // namespace ortung::python
