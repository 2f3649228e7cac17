#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "NodeMessages.hpp"
#include "Participant.hpp"

namespace ortung::ros2 {

/// The lifecycle of a managed node (ROS 2 design, "Managed nodes"): its states, and the services by
/// which Nav2's lifecycle manager leads it through them. A node that has begun its work by itself
/// belongs to the manager from the manager's first `configure` on. Thread-safe.
class Lifecycle {
 public:
  /// The states between transitions; numbers of lifecycle_msgs/msg/State.
  enum class State : std::uint8_t { kUnconfigured = 1, kInactive, kActive, kFinalized };
  /// Numbers of lifecycle_msgs/msg/Transition.
  enum class Transition : std::uint8_t {
    kConfigure = 1,
    kCleanup,
    kActivate,
    kDeactivate,
    kUnconfiguredShutdown,
    kInactiveShutdown,
    kActiveShutdown
  };
  /// Hears of a change; it must not call this.
  using Listener = std::function<void(Transition, State)>;

  /// @param startsItself whether it is active at once, without a manager
  explicit Lifecycle(bool startsItself, Listener listener = {});

  /// Offers change_state, get_state and the others below the node's name.
  void serve(Participant& node);

  State state() const;
  /// @param label counts if it is not "" @return whether there was such a transition now
  bool change(std::uint8_t transition, std::string_view label = "");
  /// Transitions from the present state, and all of them with those that a node makes itself.
  std::vector<TransitionDescription> available() const;
  static std::vector<TransitionDescription> graph();
  static std::vector<LifecycleState> states();

 private:
  void tell(const TransitionDescription& change) const;

  const Listener listener_;
  mutable std::mutex mutex_;
  State state_;
  bool isManaged_;  ///< whether a manager has led it yet
  Participant::Sender events_;
};

}  // namespace ortung::ros2
