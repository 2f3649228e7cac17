#pragma once

#include <functional>
#include <vector>

#include "ServingArguments.hpp"
#include "Rescue.hpp"
#include "ortung/server/BoardCommand.hpp"
#include "ortung/server/MessageBoard.hpp"
#include "ortung/server/Recordings.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung::app {

/// @throws UsageError for paces that exclude each other
void checkPace(const ServingArguments& arguments);

/// Records that clients begin and end; those that are on when it ends are made whole, and named.
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

/// @param commands further ones that clients may give
/// Serves @p world to clients until a signal comes. Says on stdout where it listens. If the world
/// has not come to an end 2 s after the signal, the program ends with 128 + the signal's number.
/// @param goesOn asked ten times a second; "no" ends it like a signal
/// @throws UsageError, std::runtime_error
void serve(ServedWorld& world, const ServingArguments& arguments,
           std::vector<BoardCommand> commands = {}, const std::function<bool()>& goesOn = {});

}  // namespace ortung::app
