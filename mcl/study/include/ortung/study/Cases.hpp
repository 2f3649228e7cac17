#pragma once

#include <cstdint>
#include <memory>

#include "ortung/base/Export.hpp"
#include "ortung/study/Recording.hpp"
#include "ortung/study/Splice.hpp"

namespace ortung {

// Test cases that show whether a robot finds its place, made from a recording with ground truth.
// The same seed gives the same case.

/// Returns the least distance that a robot is carried [m]: 8 m, or a third of the diagonal of the
/// rectangle in which the truth lies, if that is less.
ORTUNG_API double carriedFar(const Recording& recording);

/// Returns a log with a kidnapping: it begins up to 60 s before a random time, at which the robot
/// is carried to its pose at another random time, at least carriedFar() away, from where the log
/// goes on for up to 300 s.
/// @throws std::invalid_argument if the recording has no such places, or is shorter than 10 s
ORTUNG_API std::shared_ptr<const Splice> kidnapped(
    const std::shared_ptr<const Recording>& recording, std::uint64_t seed);

/// Returns the log from a random time on, from which at least @p travelled [m] of distance
/// travelled and 20 s (a quarter of a shorter log) are left.
/// @throws std::invalid_argument if the recording has no such time
ORTUNG_API std::shared_ptr<const Splice> wokenUp(const std::shared_ptr<const Recording>& recording,
                                                 std::uint64_t seed, double travelled = 5.0);

/// Returns the log from its beginning, with kidnaps at random places (Fox, Burgard, Thrun: "Markov
/// Localization for Mobile Robots in Dynamic Environments", JAIR 11, 1999). Between two kidnaps at
/// least 30 s pass. It is as long as the log, or ends where the log ends.
/// @param rate kidnaps per metre of distance travelled [1/m]
/// @throws std::invalid_argument as kidnapped(), and for a rate that is not above 0
ORTUNG_API std::shared_ptr<const Splice> teleported(std::shared_ptr<const Recording> recording,
                                                    std::uint64_t seed, double rate);

}  // namespace ortung
