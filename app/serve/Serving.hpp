#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "Rescue.hpp"
#include "ServingArguments.hpp"
#include "Viewing.hpp"
#include "ortung/server/BoardCommand.hpp"
#include "ortung/server/MessageBoard.hpp"
#include "ortung/server/Recordings.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung::app {

/// Checks the pace of time. @throws UsageError for options that exclude each other
void checkPace(const ServingArguments& arguments);

/// Records that clients begin and end; the destructor completes and names those that are open.
class ClientRecords {
 public:
  /// @throws UsageError for a folder without clients; std::runtime_error
  explicit ClientRecords(const ServingArguments& arguments);
  ~ClientRecords();
  ClientRecords(const ClientRecords&) = delete;
  ClientRecords& operator=(const ClientRecords&) = delete;
  Recordings& recordings() { return recordings_; }

 private:
  Recordings recordings_;
  Rescue rescue_;
};

/// A message board at one port, and the page there, for one world after another: whoever has the
/// page open sees each in turn.
class Serving {
 public:
  /// @param uploads files that the page may send; whoever may control may send them
  /// @throws UsageError, std::runtime_error
  explicit Serving(const ServingArguments& arguments, const WebUploads& uploads = {});
  ~Serving();
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

  /// As serve(); the address is printed the first time.
  void run(ServedWorld& world, std::vector<BoardCommand> commands = {},
           const std::function<bool()>& goesOn = {});

 private:
  ServingArguments arguments_;
  BoardConfig config_;
  std::unique_ptr<Viewing> viewing_;
  bool isOpen_ = false;
};

/// Serves @p world to clients until a signal comes. Prints its address on stdout. If the world has
/// not ended 2 s after the signal, the program ends with 128 + the signal's number.
/// @param commands further commands that clients may give
/// @param goesOn called ten times a second; returns false to end, like a signal
/// @throws UsageError, std::runtime_error
void serve(ServedWorld& world, const ServingArguments& arguments,
           std::vector<BoardCommand> commands = {}, const std::function<bool()>& goesOn = {});

}  // namespace ortung::app
