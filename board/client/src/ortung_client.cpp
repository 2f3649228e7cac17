#include "ortung/client/ortung_client.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <string>

#include "ortung/client/RemoteRobot.hpp"

struct ortung_robot {
  ortung_robot(const char* file, const ortung::RemoteOptions& options) : remote(file, options) {}

  void note(const std::string& what) {
    const std::lock_guard lock(mutex);
    failure = what;
  }
  std::string trouble() {
    const std::lock_guard lock(mutex);
    return failure.empty() ? remote.trouble() : failure;
  }

  ortung::RemoteRobot remote;

 private:
  std::mutex mutex;
  std::string failure;  ///< message of the last call's error; "": none
};

namespace {

void copyText(const std::string& from, char* to, size_t size) {
  if (to == nullptr || size == 0) return;
  const size_t length = std::min(from.size(), size - 1);
  std::copy_n(from.data(), length, to);
  to[length] = '\0';
}

/// @throws std::invalid_argument if @p pointer is null
template <class T>
T* given(T* pointer, const char* name) {
  if (pointer == nullptr) throw std::invalid_argument(std::string(name) + " is NULL");
  return pointer;
}

/// What an action returns; C knows no exceptions, so none leaves.
template <class Result, class Action>
Result guarded(ortung_robot* robot, Result failed, Action action) {
  if (robot == nullptr) return failed;
  try {
    robot->note("");
    return action();
  } catch (const std::exception& error) {
    robot->note(error.what());
  } catch (...) {
    robot->note("an unknown error");
  }
  return failed;
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): C

ortung_robot* ortung_connect(const char* host, uint16_t port, const char* robot_file,
                             const char* name, const char* token, double cycle_s, char* error,
                             size_t error_size) {
  copyText("", error, error_size);
  try {
    ortung::RemoteOptions options;
    options.session.host = given(host, "host");
    options.session.port = port;
    options.session.name = given(name, "name");
    if (token != nullptr) options.session.token = token;
    options.session.isBinary = true;
    options.cycle = cycle_s;
    return new ortung_robot(given(robot_file, "robot_file"), options);
  } catch (const std::exception& exception) {
    copyText(exception.what(), error, error_size);
  } catch (...) {
    copyText("an unknown error", error, error_size);
  }
  return nullptr;
}

void ortung_disconnect(ortung_robot* robot) { delete robot; }

int ortung_set_velocity(ortung_robot* robot, double translational, double rotational) {
  return guarded(robot, 0, [&] {
    robot->remote.setTranslationalVelocity(translational);
    robot->remote.setRotationalVelocity(rotational);
    return 1;
  });
}

int ortung_set_motion(ortung_robot* robot, const double* command, size_t count) {
  return guarded(robot, 0, [&] {
    if (count > 0) given(command, "command");
    robot->remote.setMotion({command, count});
    return 1;
  });
}

int ortung_set_manipulator(ortung_robot* robot, const char* manipulator, const char* state) {
  return guarded(robot, 0, [&] {
    robot->remote.setManipulator(given(manipulator, "manipulator"), given(state, "state"));
    return 1;
  });
}

int ortung_max_velocity(ortung_robot* robot, double* translational, double* rotational) {
  return guarded(robot, 0, [&] {
    const ortung::RobotDescription description = robot->remote.description();
    if (!description.maxTranslationalVelocity || !description.maxRotationalVelocity)
      throw std::runtime_error("the server does not say how fast the robot can be");
    if (translational != nullptr) *translational = *description.maxTranslationalVelocity;
    if (rotational != nullptr) *rotational = *description.maxRotationalVelocity;
    return 1;
  });
}

int ortung_mount(ortung_robot* robot, const char* feature, double* x, double* y, double* theta) {
  return guarded(robot, 0, [&] {
    const ortung::RobotDescription description = robot->remote.description();
    const auto* found = description.find(ortung::parseSensorQuery(given(feature, "feature")));
    if (found == nullptr || !found->mount)
      throw std::runtime_error(std::string("the server does not say where ") + feature + " is");
    if (x != nullptr) *x = found->mount->x;
    if (y != nullptr) *y = found->mount->y;
    if (theta != nullptr) *theta = found->mount->theta;
    return 1;
  });
}

int ortung_update(ortung_robot* robot) {
  return guarded(robot, 0, [&] { return robot->remote.update() ? 1 : 0; });
}

int ortung_next(ortung_robot* robot, uint64_t cycles) {
  return guarded(robot, 0, [&] { return robot->remote.next(cycles) ? 1 : 0; });
}

int ortung_wait_for_update(ortung_robot* robot, double timeout_s) {
  return guarded(robot, 0, [&] { return robot->remote.waitForUpdate(timeout_s) ? 1 : 0; });
}

long ortung_read(ortung_robot* robot, const char* feature, uint32_t* words, size_t capacity,
                 int64_t* stamp) {
  return guarded(robot, -1L, [&] {
    const ortung::SensorQuery query = ortung::parseSensorQuery(given(feature, "feature"));
    if (capacity > 0) given(words, "words");
    const ortung::SensorContainer& container = robot->remote.container();
    const auto lock = container.read();
    const ortung::SensorData* data = container.find(query);
    if (data == nullptr || data->sequence() == 0) return -1L;
    const auto reading = data->getData();
    std::copy_n(reading.begin(), std::min(capacity, reading.size()), words);
    if (stamp != nullptr) *stamp = data->stamp();
    return static_cast<long>(reading.size());
  });
}

int ortung_is_connected(ortung_robot* robot) {
  return robot != nullptr && robot->remote.isConnected() ? 1 : 0;
}

void ortung_trouble(ortung_robot* robot, char* text, size_t size) {
  copyText("", text, size);
  try {
    copyText(robot == nullptr ? "robot is NULL" : robot->trouble(), text, size);
  } catch (...) {  // no memory
  }
}

// NOLINTEND(readability-identifier-naming)
