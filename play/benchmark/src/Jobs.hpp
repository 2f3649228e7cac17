#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ortung {

/// Does independent jobs with several threads; neither the order nor the thread matters. The first
/// exception ends all, and is thrown again.
/// @param makeWorker called once by each thread; what it returns is called with the number of a job
/// @param goesOn called by the calling thread with the share that is done; false ends the run. May
///   be empty.
template <class MakeWorker>
void doJobs(std::size_t count, unsigned threads, const std::function<bool(double)>& goesOn,
            const MakeWorker& makeWorker) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> isOver = false;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&](bool tells) {
    try {
      auto worker = makeWorker();
      for (std::size_t i = next++; i < count && !isOver; i = next++) {
        worker(i);
        if (tells && goesOn && !goesOn(static_cast<double>(i + 1) / static_cast<double>(count)))
          throw std::runtime_error("the benchmark was ended before it was done");
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      isOver = true;
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < threads && i < count; ++i) others.emplace_back(work, false);
    work(true);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ortung
