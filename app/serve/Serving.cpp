#include "Serving.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "Console.hpp"
#include "HostPort.hpp"
#include "Interrupt.hpp"
#include "Rescue.hpp"
#include "TokenFile.hpp"
#include "Viewing.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace ortung::app {
namespace {

/// Parses address and port of "[ADDRESS:]PORT".
void readListen(const std::string& text, BoardConfig& config) {
  const bool hasAddress = text.find(':') != text.npos;
  const auto found = parseHostPort(hasAddress ? text : ":" + text);
  if (!found || !found->port)
    throw UsageError(
        fmt::format("--listen is '{}', expected [ADDRESS:]PORT with a port from 0 to "
                    "65535, e.g. 7777",
                    text));
  if (hasAddress) config.address = found->host;
  config.port = *found->port;
}

/// Has the system allow as many open files as clients, their WebSockets (three files each) and
/// connections that are none yet may take together: 1024 is what many systems allow at first.
void allowFiles(std::size_t clients) {
  const rlim_t needed = 1024 + 8 * clients;
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur >= needed) return;
  files.rlim_cur = std::min(files.rlim_max, needed);
  ::setrlimit(RLIMIT_NOFILE, &files);  // if not, who comes later waits until others leave
}

/// Ends the program if it runs for too long after a signal, e.g. because a cycle of the world
/// hangs.
class Deadline {
 public:
  explicit Deadline(MessageBoard& board)
      : thread_([this, &board](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          const auto isTold = [] { return interruptSignal() != 0; };
          while (!isTold() && !stop.stop_requested()) wake_.wait_for(lock, stop, kLook, isTold);
          // In slices: however long the whole program stood, one of them is over.
          for (auto left = kLongestEnd / kLook; left > 0 && !stop.stop_requested(); --left)
            wake_.wait_for(lock, stop, kLook, [] { return false; });
          if (stop.stop_requested()) return;
          board.abandon("the server ends, since its world does not end");
          std::thread(endSoon).detach();
          Rescue::saveAllAndEnd(fmt::format("the world has not ended within {} s after the signal",
                                            kLongestEnd.count()),
                                128 + interruptSignal());
        }) {}

 private:
  static constexpr std::chrono::milliseconds kLook{100};
  static constexpr std::chrono::seconds kLongestEnd{2};
  static constexpr std::chrono::seconds kLongestSaving{5};

  /// What is saved may be what the world hangs in.
  static void endSoon() {
    std::this_thread::sleep_for(kLongestSaving);
    std::_Exit(128 + interruptSignal());
  }

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  ///< last member: it ends before what it uses
};

/// Opens the board. If the default port is taken and was not requested, another one is used.
/// @param isKnown whether clients know the port already
std::unique_ptr<MessageBoard> openBoard(ServedWorld& world, BoardConfig& config,
                                        const ServingArguments& arguments, bool isKnown) {
  try {
    return std::make_unique<MessageBoard>(world, config);
  } catch (const std::runtime_error&) {
    if (arguments.listen || isKnown) throw;
    config.port = 0;
    return std::make_unique<MessageBoard>(world, config);
  }
}

}  // namespace

void checkPace(const ServingArguments& arguments) {
  if (arguments.freeRun && arguments.speed != 1.0)
    throw UsageError("--free-run and --speed exclude each other");
  if (arguments.freeRun && arguments.lockstep)
    throw UsageError(
        "--free-run and --lockstep exclude each other: in lockstep, clients set the pace");
}

ClientRecords::ClientRecords(const ServingArguments& arguments)
    : recordings_({.folder = arguments.recordInto, .onProblem = warn}),
      rescue_([this] { recordings_.endAll(); }) {
  if (!arguments.recordInto.empty() && !arguments.isServing())
    throw UsageError("--record-into is for --listen and --view");
}

ClientRecords::~ClientRecords() {
  for (const Recordings::State& one : recordings_.endAll())
    if (one.kind == Recordings::State::Kind::kOff)
      note(fmt::format("{}: {} moments", one.file, one.moments));
}

Serving::Serving(const ServingArguments& arguments, const WebUploads& uploads)
    : arguments_(arguments) {
  readListen(arguments.listen.value_or(Viewing::kPort), config_);
  config_.tokens = readTokens(arguments.tokens);
  for (const std::string& name : arguments.control)
    config_.control.push_back(name == "all" ? "*" : name);
  config_.speed = arguments.speed;
  if (arguments.freeRun) config_.pace = Pace::kFree;
  if (arguments.lockstep) config_.pace = Pace::kLockstep;
  config_.limits.idle = arguments.idle;
  config_.limits.slowShare = arguments.mapShare;
  config_.limits.sessions = arguments.clients;
  config_.limits.sessionsOfAddress = arguments.clientsOfAddress;
  allowFiles(arguments.clients);
  config_.log = warn;
  viewing_ = std::make_unique<Viewing>(arguments, config_, uploads);
}

Serving::~Serving() = default;

void Serving::run(ServedWorld& world, std::vector<BoardCommand> commands,
                  const std::function<bool()>& goesOn) {
  config_.commands = std::move(commands);
  try {
    const std::unique_ptr<MessageBoard> opened = openBoard(world, config_, arguments_, isOpen_);
    MessageBoard& board = *opened;
    if (!isOpen_) {
      fmt::print("listening on {} port {}\n", config_.address, board.port());
      viewing_->open(board);
      flushOutput();
    }
    isOpen_ = true;
    config_.port = board.port();
    const Deadline deadline(board);
    const Rescue rescue([&] { board.abandon("the server ends, a plugin of its world hangs"); });
    board.run([&] { return interruptSignal() == 0 && (!goesOn || goesOn()); });
    const BoardStatistics statistics = board.statistics();
    note(fmt::format("{} cycles, {} missed", statistics.cycles, statistics.missedCycles));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void serve(ServedWorld& world, const ServingArguments& arguments,
           std::vector<BoardCommand> commands, const std::function<bool()>& goesOn) {
  Serving(arguments).run(world, std::move(commands), goesOn);
}

}  // namespace ortung::app
