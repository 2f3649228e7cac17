#include "SweepCosts.hpp"

#include <algorithm>

namespace ortung::app {

SweepCosts::SweepCosts(const std::vector<std::string>& keys)
    : seed_(static_cast<std::size_t>(std::find(keys.begin(), keys.end(), "seed") - keys.begin())) {}

std::vector<std::vector<std::string>> SweepCosts::groupsOf(const SweepTask& task) const {
  std::vector<std::string> alike = task.values;
  if (seed_ < alike.size()) alike[seed_].clear();
  std::vector<std::string> first(task.values.size() + 1);  // longer, so that it is no other group
  if (!task.values.empty() && seed_ != 0) first.front() = task.values.front();
  return {alike, first, {}};
}

void SweepCosts::add(const SweepTask& task, const SweepCost& cost) {
  ++known_;
  for (const auto& group : groupsOf(task)) {
    Sum& sum = sums_[group];
    ++sum.count;
    sum.seconds += cost.seconds;
    sum.megabytes = std::max(sum.megabytes, cost.megabytes);
  }
}

std::optional<SweepCost> SweepCosts::estimate(const SweepTask& task) const {
  for (const auto& group : groupsOf(task)) {
    const auto sum = sums_.find(group);
    if (sum != sums_.end())
      return SweepCost{sum->second.seconds / static_cast<double>(sum->second.count),
                       sum->second.megabytes};
  }
  return std::nullopt;
}

}  // namespace ortung::app
