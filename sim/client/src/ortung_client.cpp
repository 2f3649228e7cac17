#include "ortung/client/ortung_client.h"

#include <algorithm>
#include <string>

#include "ortung/client/RemoteRobot.hpp"

struct ortung_robot {
  ortung_robot(const char* file, const ortung::RemoteOptions& options) : remote(file, options) {}
  ortung::RemoteRobot remote;
};

namespace {

void copyText(const std::string& from, char* to, size_t size) {
  if (to == nullptr || size == 0) return;
  const size_t length = std::min(from.size(), size - 1);
  std::copy_n(from.data(), length, to);
  to[length] = '\0';
}

/// C knows no exceptions, so none leaves.
template <class Action>
int guarded(Action action) {
  try {
    return action() ? 1 : 0;
  } catch (...) {
    return 0;
  }
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): C

ortung_robot* ortung_connect(const char* host, uint16_t port, const char* robot_file,
                             const char* name, const char* token, double cycle_s, char* error,
                             size_t error_size) {
  copyText("", error, error_size);
  try {
    ortung::RemoteOptions options;
    options.session.host = host;
    options.session.port = port;
    options.session.name = name;
    if (token != nullptr) options.session.token = token;
    options.cycle = cycle_s;
    return new ortung_robot(robot_file, options);
  } catch (const std::exception& exception) {
    copyText(exception.what(), error, error_size);
  } catch (...) {
    copyText("an unknown error", error, error_size);
  }
  return nullptr;
}

void ortung_disconnect(ortung_robot* robot) { delete robot; }

int ortung_set_velocity(ortung_robot* robot, double translational, double rotational) {
  return guarded([&] {
    robot->remote.setTranslationalVelocity(translational);
    robot->remote.setRotationalVelocity(rotational);
    return true;
  });
}

int ortung_set_motion(ortung_robot* robot, const double* command, size_t count) {
  return guarded([&] {
    robot->remote.setMotion({command, count});
    return true;
  });
}

int ortung_set_manipulator(ortung_robot* robot, const char* manipulator, const char* state) {
  return guarded([&] {
    robot->remote.setManipulator(manipulator, state);
    return true;
  });
}

int ortung_update(ortung_robot* robot) {
  return guarded([&] { return robot->remote.update(); });
}

int ortung_next(ortung_robot* robot, uint64_t cycles) {
  return guarded([&] { return robot->remote.next(cycles); });
}

int ortung_wait_for_update(ortung_robot* robot, double timeout_s) {
  return guarded([&] { return robot->remote.waitForUpdate(timeout_s); });
}

long ortung_read(ortung_robot* robot, const char* feature, uint32_t* words, size_t capacity,
                 int64_t* stamp) {
  try {
    const ortung::SensorContainer& container = robot->remote.container();
    const auto lock = container.read();
    const ortung::SensorData* data = container.find(ortung::parseSensorQuery(feature));
    if (data == nullptr || data->sequence() == 0) return -1;
    const auto reading = data->getData();
    std::copy_n(reading.begin(), std::min(capacity, reading.size()), words);
    if (stamp != nullptr) *stamp = data->stamp();
    return static_cast<long>(reading.size());
  } catch (...) {
    return -1;
  }
}

int ortung_is_connected(ortung_robot* robot) {
  return guarded([&] { return robot->remote.isConnected(); });
}

void ortung_trouble(ortung_robot* robot, char* text, size_t size) {
  guarded([&] {
    copyText(robot->remote.trouble(), text, size);
    return true;
  });
}

// NOLINTEND(readability-identifier-naming)
