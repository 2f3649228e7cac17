#include "PluginProgress.hpp"

#include <atomic>

namespace ortung {
namespace {

constinit std::atomic<std::uint64_t> progress = 0;

}  // namespace

void notePluginProgress() { progress.fetch_add(1, std::memory_order_relaxed); }
std::uint64_t pluginProgress() { return progress.load(std::memory_order_relaxed); }

}  // namespace ortung
