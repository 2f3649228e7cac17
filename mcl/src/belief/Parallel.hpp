#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>

#include "ortung/base/Workers.hpp"

namespace ortung {

inline constexpr std::size_t kChunk = 2048;  ///< samples per chunk; even, to align random numbers

/// Calls work(first, count) for all chunks of [0, n). Any thread may do any chunk, so @p work must
/// depend on its chunk alone. An exception that it throws is rethrown once all chunks have ended.
/// @param workers borrowed; null: the calling thread does all chunks
template <class Work>
void forEachChunk(std::size_t n, Workers* workers, const Work& work) {
  constexpr std::size_t kFewChunks = 4;  // waking a thread costs as much as one chunk
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  const auto run = [&](std::size_t c) { work(c * kChunk, std::min(kChunk, n - c * kChunk)); };
  if (workers == nullptr || chunks < kFewChunks) {
    for (std::size_t c = 0; c < chunks; ++c) run(c);
    return;
  }
  std::mutex mutex;
  std::exception_ptr failure;
  workers->run(chunks, [&](std::size_t c) noexcept {
    try {
      run(c);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ortung
