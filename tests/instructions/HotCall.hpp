#pragma once

#include <functional>
#include <string>
#include <vector>

/// The calls that all the rest waits for, each ready to be made again and again in the same way.
namespace ortung::instructions {

struct HotCall {
  std::string name;
  /// Makes the call. It always does the same amount of work: all random numbers have fixed seeds.
  std::function<void()> make;
};
using HotCalls = std::vector<HotCall>;

/// Each appends the calls of one part of the system.
void addWeighing(HotCalls& calls);
void addFiltering(HotCalls& calls);
void addSimulation(HotCalls& calls);
void addTalk(HotCalls& calls);

}  // namespace ortung::instructions
