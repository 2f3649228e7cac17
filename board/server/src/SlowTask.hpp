#pragma once

#include <functional>

namespace ortung::server {

/// Work beside the world and the conversations, in three steps, called one after the other.
struct SlowTask {
  std::function<bool()> begin;  ///< whether anybody still wants it; false: that was all
  std::function<void()> work;   ///< takes long; throws nothing
  std::function<void()> done;   ///< passes on what has become of it

  void run() const {
    if (!begin()) return;
    work();
    done();
  }
};

}  // namespace ortung::server
