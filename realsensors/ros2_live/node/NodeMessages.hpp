#pragma once

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "Cdr.hpp"
#include "ortung/ros2/Messages.hpp"

// What a node of ROS 2 says and is asked beside its work: its lifecycle, its parameters, and that
// it lives. Field by field as the packages define them (with Ortung's names).
namespace ortung::ros2 {

/// A request or answer without content, which has one byte since IDL knows no empty struct.
struct Nothing {
  std::uint8_t byte = 0;
};

/// A state of a node with a lifecycle (lifecycle_msgs/msg/State).
struct LifecycleState {
  std::uint8_t id = 0;
  std::string label;
};
/// A change of state (lifecycle_msgs/msg/Transition).
struct LifecycleTransition {
  std::uint8_t id = 0;
  std::string label;  ///< counts if the id is 0
};
/// lifecycle_msgs/msg/TransitionDescription
struct TransitionDescription {
  LifecycleTransition transition;
  LifecycleState start, goal;
};
struct TransitionEvent {
  static constexpr std::string_view kType = "lifecycle_msgs/msg/TransitionEvent";
  std::uint64_t timestamp = 0;  ///< [ns]
  LifecycleTransition transition;
  LifecycleState start, goal;
};

/// One side of a bond says that it lives (bond/msg/Status).
struct BondStatus {
  static constexpr std::string_view kType = "bond/msg/Status";
  Header header;
  std::string id;        ///< name of the bond
  std::string instance;  ///< of the side
  bool isActive = false;
  float timeout = 0.0F;  ///< after which the other side is dead [s]
  float period = 0.0F;   ///< between two of these [s]
};

/// A value of a parameter, of which the one of its type counts (rcl_interfaces/msg/ParameterValue).
struct ParameterValue {
  enum Type : std::uint8_t { kNotSet, kBool, kInteger, kDouble, kString };
  std::uint8_t type = kNotSet;  ///< more than these are lists
  bool flag = false;
  std::int64_t integer = 0;
  double number = 0.0;
  std::string text;
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> flags;
  std::vector<std::int64_t> integers;
  std::vector<double> numbers;
  std::vector<std::string> texts;
};
/// rcl_interfaces/msg/Parameter
struct NamedParameter {
  std::string name;
  ParameterValue value;
};
/// rcl_interfaces/msg/ParameterEvent: parameters that are there, have changed, or are gone.
struct ParameterEvent {
  static constexpr std::string_view kType = "rcl_interfaces/msg/ParameterEvent";
  std::int64_t stamp = 0;  ///< [ns]
  std::string node;
  std::vector<NamedParameter> added, changed, deleted;
};
/// rcl_interfaces/msg/ParameterDescriptor
struct ParameterDescriptor {
  struct FloatRange {
    double from = 0.0, to = 0.0, step = 0.0;
  };
  struct IntegerRange {
    std::int64_t from = 0, to = 0;
    std::uint64_t step = 0;
  };
  std::string name;
  std::uint8_t type = ParameterValue::kNotSet;
  std::string description, constraints;
  bool isReadOnly = false, hasAnyType = false;
  std::vector<FloatRange> floatRange;      ///< one at most
  std::vector<IntegerRange> integerRange;  ///< one at most
};
/// rcl_interfaces/msg/SetParametersResult
struct SetParameterResult {
  bool isDone = false;
  std::string reason;  ///< why not
};

void fields(auto& a, Is<Nothing> auto& m) { a(m.byte); }
void fields(auto& a, Is<LifecycleState> auto& m) {
  a(m.id);
  a(m.label);
}
void fields(auto& a, Is<LifecycleTransition> auto& m) {
  a(m.id);
  a(m.label);
}
void fields(auto& a, Is<TransitionDescription> auto& m) {
  a(m.transition);
  a(m.start);
  a(m.goal);
}
void fields(auto& a, Is<TransitionEvent> auto& m) {
  a(m.timestamp);
  a(m.transition);
  a(m.start);
  a(m.goal);
}
void fields(auto& a, Is<BondStatus> auto& m) {
  a(m.header);
  a(m.id);
  a(m.instance);
  a(m.isActive);
  a(m.timeout);
  a(m.period);
}
void fields(auto& a, Is<ParameterValue> auto& m) {
  a(m.type);
  a(m.flag);
  a(m.integer);
  a(m.number);
  a(m.text);
  a(m.bytes);
  a(m.flags);
  a(m.integers);
  a(m.numbers);
  a(m.texts);
}
void fields(auto& a, Is<NamedParameter> auto& m) {
  a(m.name);
  a(m.value);
}
void fields(auto& a, Is<ParameterEvent> auto& m) {
  a.time(m.stamp);
  a(m.node);
  a(m.added);
  a(m.changed);
  a(m.deleted);
}
void fields(auto& a, Is<ParameterDescriptor::FloatRange> auto& m) {
  a(m.from);
  a(m.to);
  a(m.step);
}
void fields(auto& a, Is<ParameterDescriptor::IntegerRange> auto& m) {
  a(m.from);
  a(m.to);
  a(m.step);
}
void fields(auto& a, Is<ParameterDescriptor> auto& m) {
  a(m.name);
  a(m.type);
  a(m.description);
  a(m.constraints);
  a(m.isReadOnly);
  a(m.hasAnyType);
  a(m.floatRange);
  a(m.integerRange);
}
void fields(auto& a, Is<SetParameterResult> auto& m) {
  a(m.isDone);
  a(m.reason);
}

/// A text (std_msgs/msg/String).
struct Text {
  static constexpr std::string_view kType = "std_msgs/msg/String";
  std::string data;
};
/// The answer of a service that loads a map (nav2_msgs/srv/LoadMap).
struct LoadedMap {
  enum Result : std::uint8_t {
    kSuccess = 0,
    kNoSuchMap = 1,
    kInvalidData = 2,
    kInvalidMetadata = 3,
    kUndefinedFailure = 255
  };
  OccupancyGrid map;
  std::uint8_t result = kUndefinedFailure;
};
void fields(auto& a, Is<Text> auto& m) { a(m.data); }
void fields(auto& a, Is<LoadedMap> auto& m) {
  a(m.map);
  a(m.result);
}

/// The time of day [ns since 1970].
inline std::int64_t timeOfDay() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

/// The bytes of an answer that is these fields one after another.
template <class... Parts>
std::string cdrOf(const Parts&... parts) {
  CdrWriter out;
  (out(parts), ...);
  return out.take();
}

/// Reads a request that is these fields one after another from untrusted bytes.
/// @throws std::invalid_argument telling what was found
template <class... Parts>
void readCdr(std::string_view cdr, Parts&... parts) {
  CdrReader in(cdr);
  (in(parts), ...);
  if (!in.why().empty()) throw std::invalid_argument(in.why());
}

}  // namespace ortung::ros2
