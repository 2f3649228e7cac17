#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ortung/mcl_served/PerceivedPlayback.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::app {

/// Maps of p(s given l) at some moments of a run, and why, for a page that can't compute them.
struct KeptMaps {
  /// One moment, as the page reads it.
  struct Moment {
    Timestamp stamp = 0;  ///< time on the time line [us]
    std::string json;     ///< text, see board/web/page/src/link/KeptMaps.ts
  };
  std::vector<Moment> moments;  ///< kept moments in the order of time
  std::size_t leftOut = 0;      ///< moments for which there was no room
};

/// Returns @p most moments of a run, in the order of time: up to half of them are events, evenly
/// chosen, and the others lie evenly between its beginning and its end.
std::vector<Timestamp> momentsOf(const ServedPlayback& playback, RobotId robot, std::size_t most);

/// Computes all of a run's moments; where there is no room for all of them, those that are left lie
/// evenly over the run, too.
/// @param world has its tables
/// @param room greatest number of bytes of all moments together, as @p packed makes them
/// @param progress called with the share that is done; false gives up
/// @throws Interrupted
KeptMaps keptMaps(PerceivedPlayback& world, RobotId robot, const std::vector<Timestamp>& stamps,
                  std::size_t room, const std::function<std::string(const std::string&)>& packed,
                  const std::function<bool(double)>& progress);

}  // namespace ortung::app
