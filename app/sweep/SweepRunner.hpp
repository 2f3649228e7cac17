#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "SweepStore.hpp"

namespace ortung::app {

/// Runs tasks as programs of their own, so that one that crashes takes nothing with it.
class SweepRunner {
 public:
  /// @param store, sweep borrowed @param jobs how many run at a time
  SweepRunner(const SweepStore& store, const SweepFile& sweep, unsigned jobs)
      : store_(store), sweep_(sweep), jobs_(jobs) {}

  /// Runs tasks. @param done called after each one
  /// @returns the names of those that failed @throws Interrupted
  std::vector<std::string> run(const std::vector<SweepTask>& tasks,
                               const std::function<void(std::size_t)>& done);
  /// Returns what they cost.
  const std::map<std::string, SweepCost>& costs() const { return costs_; }

 private:
  int start(const SweepTask& task, int said) const;

  const SweepStore& store_;
  const SweepFile& sweep_;
  unsigned jobs_;
  std::map<std::string, SweepCost> costs_;
};

}  // namespace ortung::app
