#pragma once

#include <map>
#include <optional>
#include <string>

#include "ortung/base/Time.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung::app {

/// What a localization's updates were like.
class UpdateCount {
 public:
  void add(const PoseEstimate& estimate);
  std::size_t updates() const { return updates_; }
  /// Returns the time between the first and the last update [s].
  double seconds() const;
  /// Returns a sentence about runs of which the lesser part was tracked: how many updates there
  /// were, the reason of most of the others, and what the status needs; "" for other runs.
  std::string whyNotTracked() const;

 private:
  std::size_t updates_ = 0;
  std::size_t tracked_ = 0;
  std::map<TrackReason, std::size_t> reasons_;  ///< of the others
  std::optional<Timestamp> first_;
  Timestamp last_ = 0;
};

}  // namespace ortung::app
