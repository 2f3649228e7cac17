#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/formats/Words.hpp"

/// Small things that several formats need.
namespace ortung {

inline void checkWordCount(std::span<const std::uint32_t> words, std::size_t expected) {
  if (words.size() != expected) {
    throw std::invalid_argument("found " + std::to_string(words.size()) + " words, expected " +
                                std::to_string(expected));
  }
}

/// Of a list: so many words for each entry. @param what e.g. "three a sighting and at most 4096
/// sightings"
inline void checkEntries(std::span<const std::uint32_t> words, std::size_t each, std::size_t most,
                         const char* what) {
  if (words.size() % each != 0 || words.size() > most * each) {
    throw std::invalid_argument("found " + std::to_string(words.size()) + " words, expected " +
                                what);
  }
}

inline void checkAngleWord(std::uint32_t word) {
  if (word >= words::kAngles) {
    throw std::invalid_argument("found the angle word " + std::to_string(word) +
                                ", expected below 36000");
  }
}

/// How far apart headings may be so that a sensor with this field of view sees everything.
inline double spacingOf(double fieldOfView) {
  if (fieldOfView <= 0.0 || fieldOfView >= kTurn) return kTurn;
  // Half the field of view, so that nothing hides between the edges of two views.
  return kTurn / std::ceil(2 * kTurn / fieldOfView);
}

/// Half the angle that a sensor with this field of view sees.
inline double halfViewOf(double fieldOfView) {
  return 0.5 * (fieldOfView <= 0.0 || fieldOfView > kTurn ? kTurn : fieldOfView);
}

std::string mountKey(const Pose2& mount);  ///< "mount=0.1,0,0"
std::string keyNumber(double value);       ///< "%.9g", for learning keys

/// Shortest signed way from angle b to angle a, each within a few turns.
inline float angleDifference(float a, float b) {
  const float d = (a - b) * (1.0F / kTurnFloat);
  return (d - std::nearbyintf(d)) * kTurnFloat;
}

}  // namespace ortung
