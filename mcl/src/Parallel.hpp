#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace ortung {

inline constexpr std::size_t kChunk = 2048;  ///< samples; even, so that random numbers stay aligned

/// Calls work(first, count) for all chunks of [0, n) on up to @p threads threads. Which thread does
/// which chunk is open, so work must depend on its chunk alone. What it throws is thrown once all
/// have ended.
template <class Work>
void forEachChunk(std::size_t n, unsigned threads, const Work& work) {
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  const auto run = [&](std::size_t begin, std::size_t stride) {
    for (std::size_t c = begin; c < chunks; c += stride)
      work(c * kChunk, std::min(kChunk, n - c * kChunk));
  };
  const std::size_t workers =
      std::min<std::size_t>(threads, chunks / 2);  // a thread costs as much as a chunk
  if (workers < 2) {
    run(0, 1);
    return;
  }
  std::vector<std::exception_ptr> failures(workers);
  const auto tryRun = [&](std::size_t w) noexcept {
    try {
      run(w, workers);
    } catch (...) {
      failures[w] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t w = 1; w < workers; ++w) others.emplace_back(tryRun, w);
    tryRun(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace ortung
