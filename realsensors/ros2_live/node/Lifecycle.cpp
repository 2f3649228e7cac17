#include "Lifecycle.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ortung::ros2 {
namespace {

using State = Lifecycle::State;
using Transition = Lifecycle::Transition;

/// A transition that somebody asks for, and the state in which the node is meanwhile.
struct Edge {
  Transition transition;
  const char* label;
  State from;
  std::uint8_t meanwhile;
  State to;
};
constexpr std::uint8_t kShuttingDown = 12;
constexpr std::uint8_t kErrorProcessing = 15;
constexpr std::array<Edge, 7> kEdges = {{
    {Transition::kConfigure, "configure", State::kUnconfigured, 10, State::kInactive},
    {Transition::kCleanup, "cleanup", State::kInactive, 11, State::kUnconfigured},
    {Transition::kActivate, "activate", State::kInactive, 13, State::kActive},
    {Transition::kDeactivate, "deactivate", State::kActive, 14, State::kInactive},
    {Transition::kUnconfiguredShutdown, "shutdown", State::kUnconfigured, kShuttingDown,
     State::kFinalized},
    {Transition::kInactiveShutdown, "shutdown", State::kInactive, kShuttingDown, State::kFinalized},
    {Transition::kActiveShutdown, "shutdown", State::kActive, kShuttingDown, State::kFinalized},
}};

/// By number, as rcl_lifecycle names them.
constexpr std::array<std::pair<std::uint8_t, const char*>, 11> kStates = {{
    {0, "unknown"},
    {1, "unconfigured"},
    {2, "inactive"},
    {3, "active"},
    {4, "finalized"},
    {10, "configuring"},
    {11, "cleaningup"},
    {kShuttingDown, "shuttingdown"},
    {13, "activating"},
    {14, "deactivating"},
    {kErrorProcessing, "errorprocessing"},
}};

LifecycleState stateOf(std::uint8_t id) {
  const auto* const found = std::find_if(kStates.begin(), kStates.end(),
                                         [&](const auto& one) { return one.first == id; });
  return {id, found->second};
}
LifecycleState stateOf(State state) { return stateOf(static_cast<std::uint8_t>(state)); }

std::uint8_t number(Transition transition) { return static_cast<std::uint8_t>(transition); }

TransitionDescription begin(const Edge& edge) {
  return {{number(edge.transition), edge.label}, stateOf(edge.from), stateOf(edge.meanwhile)};
}

}  // namespace

Lifecycle::Lifecycle(bool startsItself, Listener listener)
    : listener_(std::move(listener)),
      state_(startsItself ? State::kActive : State::kUnconfigured),
      isManaged_(!startsItself) {}

Lifecycle::State Lifecycle::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::vector<TransitionDescription> Lifecycle::available() const {
  const State now = state();
  std::vector<TransitionDescription> all;
  for (const Edge& edge : kEdges)
    if (edge.from == now) all.push_back(begin(edge));
  return all;
}

std::vector<LifecycleState> Lifecycle::states() {
  std::vector<LifecycleState> all;
  for (const auto& [id, label] : kStates) all.push_back({id, label});
  return all;
}

std::vector<TransitionDescription> Lifecycle::graph() {
  std::vector<TransitionDescription> all;
  for (const Edge& edge : kEdges) {
    all.push_back(begin(edge));
    // What comes of it has the tenfold number and its last digit: success, failure, error.
    const auto result = static_cast<std::uint8_t>(10 * number(edge.transition));
    const State failed = edge.to == State::kFinalized ? State::kFinalized : edge.from;
    const auto add = [&](int digit, const char* label, const LifecycleState& goal) {
      all.push_back(
          {{static_cast<std::uint8_t>(result + digit), label}, stateOf(edge.meanwhile), goal});
    };
    add(0, "transition_success", stateOf(edge.to));
    add(1, "transition_failure", stateOf(failed));
    add(2, "transition_error", stateOf(kErrorProcessing));
  }
  return all;
}

void Lifecycle::tell(const TransitionDescription& change) const {
  if (!events_) return;
  events_(cdrOf(TransitionEvent{static_cast<std::uint64_t>(timeOfDay()), change.transition,
                                change.start, change.goal}));
}

bool Lifecycle::change(std::uint8_t transition, std::string_view label) {
  const std::lock_guard lock(mutex_);
  const auto fits = [&](const Edge& edge) {
    return label.empty() ? number(edge.transition) == transition : label == edge.label;
  };
  // Whoever began by itself begins anew in the hands of a manager, who can't know of it.
  const bool isTakenOver = !isManaged_ && state_ == State::kActive && fits(kEdges.front());
  const State from = isTakenOver ? State::kUnconfigured : state_;
  const auto* const found = std::find_if(kEdges.begin(), kEdges.end(), [&](const Edge& edge) {
    return edge.from == from && fits(edge);
  });
  if (found == kEdges.end()) return false;
  isManaged_ = true;
  state_ = found->to;
  tell(begin(*found));
  if (listener_) listener_(found->transition, state_);
  const auto success = static_cast<std::uint8_t>(10 * number(found->transition));
  tell({{success, "transition_success"}, stateOf(found->meanwhile), stateOf(state_)});
  return true;
}

void Lifecycle::serve(Participant& node) {
  events_ = node.publish("~/transition_event", TransitionEvent::kType, Qos::kDefault);
  node.serve("~/change_state", "lifecycle_msgs/srv/ChangeState", [this](std::string_view request) {
    LifecycleTransition wanted;
    readCdr(request, wanted);
    return cdrOf(change(wanted.id, wanted.label));
  });
  node.serve("~/get_state", "lifecycle_msgs/srv/GetState",
             [this](std::string_view) { return cdrOf(stateOf(state())); });
  node.serve("~/get_available_states", "lifecycle_msgs/srv/GetAvailableStates",
             [](std::string_view) { return cdrOf(states()); });
  node.serve("~/get_available_transitions", "lifecycle_msgs/srv/GetAvailableTransitions",
             [this](std::string_view) { return cdrOf(available()); });
  node.serve("~/get_transition_graph", "lifecycle_msgs/srv/GetAvailableTransitions",
             [](std::string_view) { return cdrOf(graph()); });
}

}  // namespace ortung::ros2
