#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>
#include <string>

namespace ortung::python {

/// Python's threads at an object that is not thread-safe, and whose calls run without Python's
/// lock. They take turns by Visits. A process that was forked meanwhile works on with its copy of
/// the object, unless another thread was in it: that one is not there any more to end its call, so
/// each visit is refused. All members are called with Python's lock held, and so is fork().
class Gate {
 public:
  /// @param what the object, for errors: "this Batch"
  explicit Gate(std::string what) : what_(std::move(what)) {}

  /// Whether a call on the object can't end, so that even its destructor must not run.
  bool isBroken() const { return inside_ > 0 && process_ != ::getpid(); }

  class Alone;
  class Together;

 private:
  void enter() {
    if (isBroken())
      throw std::runtime_error(what_ + " was in use by another thread when this process was " +
                               "forked; make another one here");
    process_ = ::getpid();
    ++inside_;
  }

  std::string what_;
  pid_t process_ = ::getpid();
  int inside_ = 0;  ///< visits that have begun
  std::shared_mutex mutex_;
};

/// A visit that no other one runs beside. While it lasts nothing of Python may run, which could
/// come back to the object: whoever needs Python's lock has it in between only.
class Gate::Alone {
 public:
  /// @throws std::runtime_error for an object that a fork has left in the middle of a call
  explicit Alone(Gate& gate) : gate_(gate) {
    gate.enter();
    const pybind11::gil_scoped_release others;
    gate.mutex_.lock();
  }
  ~Alone() {
    gate_.mutex_.unlock();
    --gate_.inside_;
  }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

 private:
  Gate& gate_;
};

/// A visit that others of its kind may run beside.
class Gate::Together {
 public:
  /// @throws std::runtime_error as Alone
  explicit Together(Gate& gate) : gate_(gate) {
    gate.enter();
    const pybind11::gil_scoped_release others;
    gate.mutex_.lock_shared();
  }
  ~Together() {
    gate_.mutex_.unlock_shared();
    --gate_.inside_;
  }
  Together(const Together&) = delete;
  Together& operator=(const Together&) = delete;

 private:
  Gate& gate_;
};

/// Calls @p work alone at the gate, without Python's lock.
template <class Work>
decltype(auto) alone(Gate& gate, const Work& work) {
  const Gate::Alone visit(gate);
  const pybind11::gil_scoped_release others;
  return work();
}

/// Gives an object up that a broken gate keeps from being destroyed.
template <class T>
void leave(std::unique_ptr<T>& object) {
  [[maybe_unused]] const T* const left = object.release();
}

/// What was opened before a fork reads from the same files as the process that opened it.
class OpenedHere {
 public:
  bool isHere() const { return process_ == ::getpid(); }
  /// @throws std::runtime_error in another process. @param what "these readings"
  void check(const std::string& what) const {
    if (!isHere())
      throw std::runtime_error(what + " were opened before this process was forked, and both " +
                               "would read from the same place; open them here");
  }

 private:
  pid_t process_ = ::getpid();
};

}  // namespace ortung::python
