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

/// What a client said behind a command of whoever hosts the board, taken piece by piece, by the
/// rules of the protocol's own commands. Refusals are ServeErrors: of a number that is none or out
/// of its bounds, and at the end of what nobody asked for. Not thread-safe.
class ORTUNG_API CallArguments {
 public:
  /// @param name of the command, for errors
  CallArguments(const std::string& name, const BoardCommand::Call& call);
  ~CallArguments();
  CallArguments(const CallArguments&) = delete;
  CallArguments& operator=(const CallArguments&) = delete;

  std::vector<std::string> takeWords();
  std::optional<std::string> takeText(std::string_view key);
  std::optional<double> takeNumber(std::string_view key, double low, double high);
  std::optional<std::int64_t> takeInteger(std::string_view key, std::int64_t low,
                                          std::int64_t high);
  /// x_m, y_m and theta_deg or theta_rad, 0 if both are missing; nothing if none is there.
  std::optional<Pose2> takePose();
  void refuseRest() const;

 private:
  std::unique_ptr<server::Request> request_;
};

/// The number behind `since=` of EVENTS, 0 if it is not there. @throws ServeError for anything else
ORTUNG_API std::uint64_t sinceOf(const BoardCommand::Call& call);

}  // namespace ortung
