#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/client/ClockOffset.hpp"
#include "ortung/client/RobotDescription.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/RobotCommands.hpp"

namespace ortung {

namespace client {
class LineSocket;
}

/// The server can't be reached any more; the message says which and why.
class ORTUNG_API ConnectionLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~ConnectionLost() override;
};

/// The server answered "ERR code text".
class ORTUNG_API ServerRefused : public std::runtime_error {
 public:
  ServerRefused(std::string code, const std::string& what)
      : std::runtime_error(what), code_(std::move(code)) {}
  ~ServerRefused() override;
  /// The error's code, one word such as "syntax" or "state" (docs/protocol.md).
  const std::string& code() const { return code_; }

 private:
  std::string code_;
};

/// Which server a session connects to, as whom, and how long it waits.
struct ORTUNG_API SessionOptions {
  std::string host = "127.0.0.1";
  std::uint16_t port = 7777;
  std::string name = "robot";    ///< name of client and robot: [A-Za-z0-9_-], 1 to 32 characters
  std::string token;             ///< secret of printable characters without blanks; "": none
  std::string team;              ///< the robot's team, spelled like a name; "": none
  std::optional<Pose2> start;    ///< pose in the field frame; nothing: anywhere
  bool wanders = false;          ///< the server drives the robot about
  bool isBinary = false;         ///< form of readings; without it there are no pictures
  double timeout = 5.0;          ///< longest wait for an answer [s], above 0
  double patience = 60.0;        ///< longest wait for the end of cycles in lockstep [s], above 0
  bool isInterruptible = false;  ///< whether a signal ends what is under way
  /// A request to stop, from any thread, ends what is under way and all later calls with
  /// ConnectionLost; only the look-up of a computer's name goes on until it is answered.
  std::stop_token stop;

  /// "HOST:PORT", for messages.
  std::string server() const { return host + ":" + std::to_string(port); }
  /// @throws std::invalid_argument for a name, a token or a time that can't be one, saying which
  void check() const;
};

/// A text that another robot of the team has sent.
struct TeamWords {
  Timestamp stamp = 0;  ///< time of the words on the server's clock [us]
  std::string from;     ///< the robot's name
  std::string text;
};

/// A connection to a message board with one robot on its field: the protocol of docs/protocol.md as
/// function calls. Each call asks and waits for the answer. Not thread-safe.
/// @throws ConnectionLost, ServerRefused from all members; std::invalid_argument for options that
///   SessionOptions::check() refuses, for what would be more than one request or other words of it,
///   and from commands where the server says that the robot does not take them
class ORTUNG_API RobotSession : public RobotCommands {
 public:
  /// Connects and creates the robot; where a running robot is served, it is that one, and start,
  /// team and drive of the options say nothing.
  /// @param robotToml text of the robot file
  RobotSession(const SessionOptions& options, std::string_view robotToml);
  ~RobotSession() override;
  RobotSession(const RobotSession&) = delete;
  RobotSession& operator=(const RobotSession&) = delete;

  /// Digest of the served world, to be compared with that of tables; "" if the server does not know
  /// it.
  const std::string& worldFingerprint() const { return fingerprint_; }
  /// "simulation", "record" or "robot".
  const std::string& kind() const { return kind_; }

  /// By the server's clock: the cycle that next() gave, whether a sensor read in it or not; without
  /// lockstep the stamp of the newest reading that came; at first the time of greeting.
  Timestamp newest() const { return newest_; }

  /// Asks the server for the robot's parameters.
  RobotDescription describe();

  /// Commands of motion, executed by the server in its next cycle: velocities along and about the
  /// robot's axes [m/s, rad/s], or the command vector of its drive.
  void setTranslationalVelocity(double metresPerSecond) override;
  void setRotationalVelocity(double radiansPerSecond) override;
  void setMotion(std::span<const double> command) override;
  /// Brings a manipulator into one of the states of describe(), given by its name.
  void setManipulator(std::string_view manipulator, std::string_view state) override;
  /// Sends a text to all other clients.
  void say(const std::string& text);
  /// Sends a text to all other robots of the team, of clients and of the server, which get it in
  /// the next cycle.
  void tellTeam(const std::string& text);
  /// Returns texts of others of the team since the last call, in the order of time.
  std::vector<TeamWords> hearTeam();
  /// Returns the state of the game, the reply to GAME (docs/protocol.md); "" if there is no game.
  std::string game();
  /// Returns readings that are new, oldest first, stamped by the server's clock.
  /// @param queries "model/type/feature", separated by blanks; "": all
  std::vector<Message> update(const std::string& queries = "");
  /// Switches lockstep on or off: in lockstep the world waits for next().
  void setLockstep(bool isOn);
  /// Lets the world go on, and returns what is new. Nothing at the end of a served record.
  std::optional<std::vector<Message>> next(std::uint64_t cycles = 1);

  /// Exchanges time stamps once, for a ClockOffset.
  /// @param clock ours
  template <class Clock>
  ClockOffset::Exchange exchangeTime(const Clock& clock) {
    ClockOffset::Exchange exchange;
    exchange.sent = clock();
    const std::string reply = ask("TIME");
    exchange.back = clock();
    exchange.received = stampOf(reply, "received");
    exchange.answered = stampOf(reply, "sent");
    return exchange;
  }

  /// Sends any request, a line of docs/protocol.md, and returns the reply without its tag. @p body
  /// gets the lines that belong to it.
  std::string ask(const std::string& request, std::vector<std::string>* body = nullptr);
  /// Returns what the server said unasked since the last call: "SAY client=2 name=bert ...".
  std::vector<std::string> takeNews();

 private:
  /// Sends CREATE with the options and the text of the robot file.
  void create(std::string_view robotToml);
  /// Whether a reading of a running robot is newer than the last one of its feature; notes its
  /// stamp.
  bool isNew(const Message& reading);
  /// Sends a request with a new tag and waits for its reply "OK ..."; other lines go to note().
  std::string exchange(const std::string& request, double timeout);
  /// Asks, and turns refusals of a command's arguments into std::invalid_argument.
  void tell(const std::string& request);
  Message takeBinary(const std::string& reply, std::size_t& left);
  std::vector<Message> takeReadings(const std::string& reply);
  std::string withForm(std::string request) const;
  std::size_t countOf(const std::string& reply, std::string_view key, std::size_t most) const;
  Timestamp stampOf(const std::string& reply, std::string_view key) const;
  void note(std::string_view line);
  /// @throws ConnectionLost with @p what the server said, which is not of the protocol
  [[noreturn]] void failOn(std::string_view what) const;

  SessionOptions options_;
  std::unique_ptr<client::LineSocket> socket_;
  std::string fingerprint_;
  std::string kind_;
  Timestamp newest_ = 0;
  /// Newest stamp of each feature of a running robot.
  std::map<std::string, Timestamp, std::less<>> stamps_;
  Timestamp clock_ = 0;  ///< time of the next cycle in lockstep [us]
  std::vector<std::string> news_;
  std::uint64_t lastTag_ = 0;
};

}  // namespace ortung
