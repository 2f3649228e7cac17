#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "SweepFile.hpp"

namespace ortung::app {

/// What a task has cost, or will.
struct SweepCost {
  double seconds = 0.0;    ///< of a core
  double megabytes = 0.0;  ///< most at a time
};

/// Estimates what tasks will cost by those that were run: by the ones from which a task differs by
/// its seed alone; if there are none, by those with the same first value (a log or a robot, as a
/// rule), or by all.
class SweepCosts {
 public:
  /// @param keys keys of the sweep; "seed" is the one that costs nothing
  explicit SweepCosts(const std::vector<std::string>& keys);

  void add(const SweepTask& task, const SweepCost& cost);
  std::size_t known() const { return known_; }  ///< number of tasks that were added
  /// Returns nothing if no task was added.
  std::optional<SweepCost> estimate(const SweepTask& task) const;

 private:
  struct Sum {
    std::size_t count = 0;
    double seconds = 0.0;
    double megabytes = 0.0;  ///< greatest of all
  };
  /// Names of the groups that a task is in, the closest first.
  std::vector<std::vector<std::string>> groupsOf(const SweepTask& task) const;

  std::size_t seed_;  ///< number of the key "seed"; the number of keys if there is none
  std::size_t known_ = 0;
  std::map<std::vector<std::string>, Sum> sums_;
};

}  // namespace ortung::app
