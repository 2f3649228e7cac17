#pragma once

namespace ortung::server {

// How Linux schedules the thread that calls. If it refuses, all threads are alike.

/// For work that nobody waits for: the thread has a tenth of the weight of others, takes no
/// processor from anyone when it wakes up, and gives its own to anyone who does.
void stepBack();

/// For a thread that has little to do, at once: when it wakes up it takes a processor from threads
/// that compute for long.
void comeForward();

}  // namespace ortung::server
