#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>

#include "ortung/base/Workers.hpp"

namespace ortung {

inline constexpr std::size_t kChunk = 2048;  ///< samples per chunk; even, to align random numbers

/// Returns the number of chunks of @p n samples.
constexpr std::size_t chunksOf(std::size_t n) { return (n + kChunk - 1) / kChunk; }

/// Calls work(i) for all i in [0, n). Any thread may do any of them, so @p work must depend on i
/// alone. An exception that it throws is rethrown once all have ended.
/// @param workers borrowed; null: the calling thread does all
template <class Work>
void forEach(std::size_t n, Workers* workers, const Work& work) {
  if (workers == nullptr) {
    for (std::size_t i = 0; i < n; ++i) work(i);
    return;
  }
  std::mutex mutex;
  std::exception_ptr failure;
  workers->run(n, [&](std::size_t i) noexcept {
    try {
      work(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

/// Calls work(first, count) for all chunks of [0, n), as forEach() does.
template <class Work>
void forEachChunk(std::size_t n, Workers* workers, const Work& work) {
  constexpr std::size_t kFewChunks = 4;  // waking a thread costs as much as one chunk
  const std::size_t chunks = chunksOf(n);
  forEach(chunks, chunks < kFewChunks ? nullptr : workers,
          [&](std::size_t c) { work(c * kChunk, std::min(kChunk, n - c * kChunk)); });
}

}  // namespace ortung
