#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace ortung {

inline constexpr std::size_t kChunk = 2048;  ///< samples; even, so that random numbers stay aligned

/// Calls work(first, count) for all chunks of [0, n) on up to @p threads threads. Which thread does
/// which chunk is open, so work must depend on its chunk alone.
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
  std::vector<std::jthread> others;
  for (std::size_t w = 1; w < workers; ++w) others.emplace_back(run, w, workers);
  run(0, workers);
}

}  // namespace ortung
