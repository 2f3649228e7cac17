#include "ortung/base/Workers.hpp"

#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace ortung {

namespace {

/// Times that a thread looks for what it waits for before it sleeps, some 20 us. Rounds follow each
/// other within microseconds, and to be woken takes longer than that. It does not give way
/// meanwhile: on a busy machine it would be away for milliseconds.
constexpr int kLooks = 1000;

/// Tells the processor that this is a loop that waits.
void relax() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__) || defined(__arm__)
  asm volatile("yield");
#endif
}

/// @returns whether @p holds became true
template <class Holds>
bool awaitBriefly(const Holds& holds) {
  for (int look = 0; look < kLooks; ++look) {
    if (holds()) return true;
    relax();
  }
  return false;
}

}  // namespace

struct Workers::Crew {
  std::mutex mutex;
  std::condition_variable begin;
  std::condition_variable end;
  std::atomic<std::uint64_t> round{0};  ///< counts calls of run(); written under the mutex
  std::atomic<unsigned> busy{0};        ///< threads that still work on this round
  std::atomic<bool> isOver{false};      ///< written under the mutex
  const std::function<void(std::size_t)>* work = nullptr;
  std::size_t count = 0;
  std::atomic<std::size_t> next{0};
  const pid_t process = ::getpid();  ///< the process that has the threads
  std::vector<std::jthread> threads;

  explicit Crew(std::size_t others) {
    try {
      for (std::size_t i = 0; i < others; ++i) threads.emplace_back([this] { live(); });
    } catch (...) {  // the system has no more threads; those that there are must end
      endAll();
      throw;
    }
  }
  ~Crew() { endAll(); }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void endAll() {
    {
      const std::lock_guard lock(mutex);
      isOver = true;
    }
    begin.notify_all();
  }
  bool isOfThisProcess() const { return threads.empty() || process == ::getpid(); }

  void workAll() {
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) (*work)(i);
  }

  void live() {
    std::uint64_t seen = 0;
    const auto isCalled = [&] { return isOver || round != seen; };
    while (true) {
      if (!awaitBriefly(isCalled)) {
        std::unique_lock lock(mutex);
        begin.wait(lock, isCalled);
      }
      if (isOver) return;
      seen = round;
      workAll();
      if (--busy > 0) continue;
      const std::lock_guard lock(mutex);
      end.notify_one();
    }
  }
};

namespace {

/// Gives an object up without ending it.
template <class T>
void leave(std::unique_ptr<T>& object) {
  [[maybe_unused]] const T* const left = object.release();
}

}  // namespace

// A process that was forked has this memory, but none of the threads: waiting for them, even to end
// them, would take for ever. So it leaves them alone, and has threads of its own from its first
// run() on.

Workers::Workers(unsigned threads) : crew_(std::make_unique<Crew>(threads > 0 ? threads - 1 : 0)) {}

Workers::~Workers() {
  if (!crew_->isOfThisProcess()) leave(crew_);
}

void Workers::run(std::size_t n, const std::function<void(std::size_t)>& work) {
  if (!crew_->isOfThisProcess()) {
    const std::size_t others = crew_->threads.size();
    leave(crew_);
    crew_ = std::make_unique<Crew>(others);
  }
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
  const auto areDone = [&] { return crew.busy == 0; };
  if (awaitBriefly(areDone)) return;
  std::unique_lock lock(crew.mutex);
  crew.end.wait(lock, areDone);
}

}  // namespace ortung
