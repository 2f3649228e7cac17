#pragma once

#include <cstdint>
#include <map>

#include "ortung/base/Export.hpp"

namespace ortung {

/// How long threads of this process were ready to run while others had the processors, as the
/// system counts it (/proc/self/task/N/schedstat). Not thread-safe.
class ORTUNG_API ProcessorWaits {
 public:
  /// @returns the greatest of such times, among all threads but those of a lower priority than the
  ///   caller's, since the last call [s]; 0 the first time, and where the system does not count
  double sinceLast();
  /// Forgets the last call: the next one is the first.
  void forget() { last_.clear(); }

 private:
  std::map<int, std::uint64_t> last_;  ///< by thread [ns]
};

}  // namespace ortung
