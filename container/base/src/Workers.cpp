#include "ortung/base/Workers.hpp"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace ortung {

struct Workers::Crew {
  std::mutex mutex;
  std::condition_variable begin;
  std::condition_variable end;
  std::uint64_t round = 0;  ///< counts calls of run()
  unsigned busy = 0;        ///< threads that still work on this round
  bool isOver = false;
  const std::function<void(std::size_t)>* work = nullptr;
  std::size_t count = 0;
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> threads;

  void workAll() {
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) (*work)(i);
  }

  void live() {
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex);
    while (true) {
      begin.wait(lock, [&] { return isOver || round != seen; });
      if (isOver) return;
      seen = round;
      lock.unlock();
      workAll();
      lock.lock();
      if (--busy == 0) end.notify_one();
    }
  }
};

Workers::Workers(unsigned threads) : crew_(std::make_unique<Crew>()) {
  for (unsigned i = 1; i < threads; ++i) crew_->threads.emplace_back([this] { crew_->live(); });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(crew_->mutex);
    crew_->isOver = true;
  }
  crew_->begin.notify_all();
}

void Workers::run(std::size_t n, const std::function<void(std::size_t)>& work) {
  Crew& crew = *crew_;
  if (crew.threads.empty() || n < 2) {
    for (std::size_t i = 0; i < n; ++i) work(i);
    return;
  }
  {
    const std::lock_guard lock(crew.mutex);
    crew.work = &work;
    crew.count = n;
    crew.next = 0;
    crew.busy = static_cast<unsigned>(crew.threads.size());
    ++crew.round;
  }
  crew.begin.notify_all();
  crew.workAll();
  std::unique_lock lock(crew.mutex);
  crew.end.wait(lock, [&] { return crew.busy == 0; });
}

}  // namespace ortung
