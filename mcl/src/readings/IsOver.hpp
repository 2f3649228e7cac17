#pragma once

#include <cstddef>
#include <functional>

namespace ortung {

/// Says that the time for some work is over, so that it stops at the next place where it can. Null:
/// it takes as long as it takes.
using IsOver = std::function<bool()>;

/// Poses that are treated between two questions: some tens of microseconds.
inline constexpr std::size_t kTimedPoses = 256;

inline bool isNow(const IsOver& over) { return over && over(); }

}  // namespace ortung
