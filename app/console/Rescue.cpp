#include "Rescue.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "Console.hpp"

namespace ortung::app {
namespace {

struct Rescues {
  std::mutex mutex;
  std::vector<Rescue*> all;
};

Rescues& rescues() {
  static Rescues rescues;
  return rescues;
}

}  // namespace

Rescue::Rescue(std::function<void()> save) : save_(std::move(save)) {
  const std::lock_guard lock(rescues().mutex);
  rescues().all.push_back(this);
}

Rescue::~Rescue() {
  const std::lock_guard lock(rescues().mutex);
  std::erase(rescues().all, this);
}

void Rescue::saveAllAndEnd(const std::string& why, int exitCode) {
  fail(why);
  const std::lock_guard lock(rescues().mutex);  // it is never released
  for (Rescue* rescue : rescues().all) {
    try {
      const auto held = rescue->hold();
      rescue->save_();
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }
  std::fflush(nullptr);
  std::_Exit(exitCode);
}

}  // namespace ortung::app
