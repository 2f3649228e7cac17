#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/server/BoardCommand.hpp"

namespace ortung {

namespace server {
class Request;
}

/// The words and keys of a call of a BoardCommand, taken piece by piece by the rules of the
/// protocol's own commands. Numbers that are malformed or out of bounds are refused with a
/// ServeError, and at the end words and keys that the command does not know. Not thread-safe.
class ORTUNG_API CallArguments {
 public:
  /// @param name of the command, for errors
  CallArguments(const std::string& name, const BoardCommand::Call& call);
  ~CallArguments();
  CallArguments(const CallArguments&) = delete;
  CallArguments& operator=(const CallArguments&) = delete;

  /// Takes all words without a key, in their order.
  std::vector<std::string> takeWords();
  /// Takes the text behind `key=`; nothing if the key is not there.
  std::optional<std::string> takeText(std::string_view key);
  /// Takes the number behind `key=`; nothing if the key is not there.
  /// @throws ServeError unless it is a finite number in [@p low, @p high]
  std::optional<double> takeNumber(std::string_view key, double low, double high);
  /// Takes the integer behind `key=`, likewise.
  std::optional<std::int64_t> takeInteger(std::string_view key, std::int64_t low,
                                          std::int64_t high);
  /// x_m, y_m and theta_deg or theta_rad, 0 if both are missing; nothing if none is there.
  std::optional<Pose2> takePose();
  /// Checks that all words and keys were taken. @throws ServeError naming what is left
  void refuseRest() const;

 private:
  std::unique_ptr<server::Request> request_;
};

/// The number behind `since=` of EVENTS, 0 if it is not there. @throws ServeError for anything else
ORTUNG_API std::uint64_t sinceOf(const BoardCommand::Call& call);

}  // namespace ortung
