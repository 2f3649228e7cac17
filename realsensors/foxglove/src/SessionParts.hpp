#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "BoardReplies.hpp"
#include "ClientMessages.hpp"
#include "DescribedRobot.hpp"
#include "FoxgloveFrames.hpp"
#include "ortung/foxglove/FoxgloveSession.hpp"

namespace ortung {

enum class Level : std::uint8_t { kInfo, kWarning, kError };

/// The state of a session.
struct FoxgloveSession::Parts {
  using BoardReply = foxglove::BoardReply;
  struct Channel {
    std::string topic;
    std::string_view type;
    std::optional<std::uint32_t> subscription;  ///< number of the client's subscription
    /// Messages that later subscribers get at once, by robot.
    std::map<std::int64_t, std::string> latched;
    std::size_t users = 0;  ///< number of robots that have the topic
  };
  struct RobotPart {
    std::unique_ptr<foxglove::DescribedRobot> robot;  ///< null until it is described
    std::vector<std::uint32_t> channels;              ///< channel of each of its topics
    std::string asked;                                ///< features subscribed at the board
  };

  FoxgloveSession& session;
  foxglove::BoardReplies board;
  std::string kind;                     ///< kind of the world: "simulation", ...
  std::optional<Timestamp> start, end;  ///< first and last time of a record
  Timestamp now = 0;
  Timestamp listed = 0;  ///< time of the last request for the robots
  bool isListing = false;
  bool isPlaybackWatched = false;  ///< whether the client has used playback control
  bool isEndTold = false;
  std::map<std::uint32_t, Channel> channels;
  std::map<std::string, std::uint32_t> channelOf;        ///< channels by topic
  std::map<std::uint32_t, std::uint32_t> subscriptions;  ///< channels by the client's subscription
  std::map<std::int64_t, RobotPart> robots;
  std::uint32_t nextChannel = 1;
  bool isTruthAsked = false;  ///< whether the world's truth is subscribed in each cycle
  bool hasWorldTruth = true;
  std::size_t faultsTold = 0;    ///< faults of the message that is taken of which it was told
  std::size_t faultsUntold = 0;  ///< and of which it was not
  std::map<std::uint32_t, foxglove::ClientChannel>
      published;               ///< channels of the client, by its id
  bool isRefusalTold = false;  ///< whether it was told that velocities are refused
  bool isCrowded = false;      ///< whether there may be several robots: topics have their names

  explicit Parts(FoxgloveSession& owner);

  // --- the board ---
  void ask(const std::string& request, foxglove::BoardReplies::Handler handler) {
    board.ask(request, std::move(handler), session.toBoard);
  }
  void greet(const std::string& token);
  void takeWorld(const BoardReply& reply);
  void takeField(const BoardReply& world, const BoardReply& reply);
  void list();
  void takeRobots(const BoardReply& reply);
  void takeRobot(std::int64_t number, const std::string& name, const BoardReply& reply);
  void removeRobot(std::int64_t number);
  void takeUnasked(const BoardReply& reply);
  void takeReadings(std::int64_t number, const BoardReply& reply);
  void takeWorldTruth(const Message& message);
  void give(std::int64_t number, std::vector<Message>& frame);
  void subscribeAtBoard();
  std::string queriesOf(const RobotPart& part) const;
  bool wantsWorldTruth() const;

  // --- the client ---
  void takeText(std::string_view message);
  void takeBinary(std::string_view message);
  void subscribe(std::uint32_t subscription, std::uint32_t channel);
  void unsubscribe(std::uint32_t subscription);
  void takeClientChannel(const nlohmann::json& channel);
  void removeClientChannel(std::uint32_t id);
  void takePublished(std::string_view message);
  std::optional<std::int64_t> robotFor(const std::string& topic);
  void order(const std::string& request, std::int64_t robot);
  void control(const foxglove::PlaybackRequest& request);
  void tellPlayback(const BoardReply& status, bool hasSought, const std::string& request);
  /// Tells it what is wrong with its message, and of that little: so an answer is not much longer
  /// than what it answers, whatever comes.
  void tell(Level level, const std::string& text);
  void tellRest();
  void sendText(std::string text) { session.toClient.push_back({std::move(text), false}); }
  void sendBinary(std::string bytes) { session.toClient.push_back({std::move(bytes), true}); }
  void sendInfo(const std::string& world);
  std::uint32_t channelFor(const ros2::Topic& topic);
  void advertise(const std::vector<std::uint32_t>& fresh);
};

}  // namespace ortung
