#pragma once

#include <chrono>
#include <cstdint>

#include "ortung/base/Export.hpp"

namespace ortung {

/// While it lives, the thread that made it lets others that wake up go first, if their slices of
/// time are shorter: for one that computes for milliseconds and has time. It gets as much time as
/// before. Before Linux 6.12, and elsewhere, nothing changes.
class ORTUNG_API Patience {
 public:
  /// Of a world that is served. Others have slices of 0.7 to 2.8 ms, unless somebody changes that.
  static constexpr std::chrono::microseconds kWorld{4'000};
  /// Of what is computed beside it, and must not hold up its cycles.
  static constexpr std::chrono::microseconds kBeside{8'000};

  /// @param slice how long the thread would like to compute at a stretch
  explicit Patience(std::chrono::microseconds slice);
  ~Patience();
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;

 private:
  std::uint64_t before_ = 0;  ///< slice of the thread [ns]; 0: it has none of its own
};

}  // namespace ortung
