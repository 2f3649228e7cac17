#include "ortung/formats/TrackStatus.hpp"

#include <cstddef>
#include <iterator>

namespace ortung {

const char* nameOf(TrackStatus status) {
  constexpr const char* kNames[] = {"tracking", "uncertain", "lost"};
  return kNames[static_cast<std::size_t>(status)];
}

const char* nameOf(TrackReason reason) {
  constexpr const char* kNames[] = {
      "readings fit",
      "several places fit",
      "the belief is spread",
      "no reading comes",
      "a device repeats its reading though the robot moves",
      "readings fit worse than usual",
      "readings fit elsewhere",
      "readings contradict odometry",
      "the field is searched",
      "readings are late",
      "few readings have confirmed the place yet",
      "no turn has shown yet that readings are in time",
  };
  static_assert(std::size(kNames) == static_cast<std::size_t>(TrackReason::kLast) + 1);
  return kNames[static_cast<std::size_t>(reason)];
}

const char* nameOf(Relocalization cause) {
  constexpr const char* kNames[] = {
      "none",
      "a global start found the robot",
      "a pose was given",
      "readings fit another place better",
      "readings are late by another time",
      "readings corrected it",
  };
  static_assert(std::size(kNames) == static_cast<std::size_t>(Relocalization::kLast) + 1);
  return kNames[static_cast<std::size_t>(cause)];
}

}  // namespace ortung
