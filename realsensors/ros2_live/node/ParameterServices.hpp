#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "AmclParameters.hpp"
#include "NodeMessages.hpp"
#include "Participant.hpp"

namespace ortung::ros2 {

/// The six services by which `ros2 param` and rqt see and change a node's parameters, and
/// /parameter_events. Each takes and gives bytes (CDR). Thread-safe.
class ParameterServices {
 public:
  using Listener = std::function<void(const AmclSettings&)>;
  /// @param node whole name of the node @param listener hears of what was changed
  ParameterServices(AmclParameters& parameters, std::string node, Listener listener)
      : parameters_(parameters), node_(std::move(node)), listener_(std::move(listener)) {}

  void serve(Participant& node);

  // The services. @throws std::invalid_argument for bytes that are no such request
  std::string get(std::string_view request) const;
  std::string types(std::string_view request) const;
  std::string describe(std::string_view request) const;
  std::string list(std::string_view request) const;
  std::string set(std::string_view request);
  std::string setAtomically(std::string_view request);

 private:
  void tellStart();
  void change(const std::vector<NamedParameter>& wanted);

  AmclParameters& parameters_;  ///< borrowed, and guarded by the mutex from now on
  const std::string node_;
  const Listener listener_;
  mutable std::mutex mutex_;
  Participant::Sender events_;
};

}  // namespace ortung::ros2
