#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "BoardClock.hpp"
#include "Question.hpp"
#include "RobotReadings.hpp"
#include "ortung/server/MessageBoard.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung::server {

using ClientId = std::uint32_t;
constexpr ClientId kNobody = 0;  ///< owns the robots of the world itself

/// Owns the world's time: executes the orders of clients between cycles and begins each cycle when
/// it is due. All but give(), stop() and statistics() belong to the thread of run().
class WorldKeeper {
 public:
  /// Takes the text of a reply; called on the world's thread.
  using Done = std::function<void(std::string)>;
  /// Executes an order; returns the reply, or nothing if it kept @p done to call it later.
  using Order = std::function<std::optional<std::string>(WorldKeeper& keeper, Done& done)>;

  /// @param onCycle called after each cycle
  WorldKeeper(ServedWorld& world, const BoardConfig& config, std::function<void()> onCycle);
  ~WorldKeeper();

  /// Clients take turns: what one gives is executed in its order, but one who gives much waits.
  void give(ClientId client, Order order, Done done);
  void run(const std::function<bool()>& goesOn);
  /// Stops the live robots that clients have commanded; for the end of run(), on its thread.
  void haltCommanded();
  void stop();
  BoardStatistics statistics() const;
  const BoardClock& clock() const { return clock_; }

  /// Executes what was given and begins a cycle if one is due: run() without waiting.
  void runOnce();

  // --- for orders; refusals are ServeErrors
  ServedWorld& world() { return world_; }
  void join(ClientId client, const std::string& name, bool isOperator);
  void leave(ClientId client);
  std::shared_ptr<RobotReadings> createRobot(ClientId client, RobotWish wish);
  void removeRobot(ClientId client, RobotId robot);
  /// @throws ServeError unless @p robot belongs to @p client
  void checkOwner(ClientId client, RobotId robot) const;
  /// Through which @p client commands @p robot: its own one, or as an operator a live one.
  RobotCommands& commands(ClientId client, RobotId robot);
  std::shared_ptr<RobotReadings> readings(RobotId robot) const;

  void setLockstep(ClientId client, bool isLockstep);
  void next(ClientId client, std::uint64_t cycles, Done done);

  void pause();
  void resume();
  void step(std::uint64_t cycles, Done done);
  void setSpeed(double speed);
  void reset(std::optional<std::uint64_t> seed);
  /// Goes to a time when it is the client's turn: seeks wait for all other orders, and have a share
  /// of the world's time (BoardLimits::seekShare). @param done gets the reply, or the refusal
  void seek(ClientId client, Timestamp stamp, std::shared_ptr<Question> question, Done done);
  /// " speed=F achieved=F [seed=N]": asked, and of the last second; 0: as fast as possible.
  std::string paceText() const;
  std::string stateText() const;  ///< "running", "paused", "waiting", "ended" or "failed"

  struct Score {
    int left = 0;
    int right = 0;
  };
  Score score;

  struct Client {
    std::string name;
    bool isOperator = false;
    std::set<RobotId> robots;
    bool isLockstep = false;
    std::uint64_t cycles = 0;  ///< cycles of its NEXT that are still to come; 0: no NEXT
    Done waiting;              ///< takes the reply to that NEXT
  };
  const std::map<ClientId, Client>& clients() const { return clients_; }
  struct Robot {
    ClientId owner;
    std::shared_ptr<RobotReadings> readings;
    double raysPerSecond = 0.0;
    double raysAtOnce = 0.0;
  };
  const std::map<RobotId, Robot>& robots() const { return robots_; }

 private:
  struct Given {
    Order order;
    Done done;
  };
  void checkLimits(const ServedRobot& robot) const;
  bool isLockstepReady() const;
  bool mayAdvance() const;
  Timestamp due();
  struct Seek {
    ClientId client;
    Timestamp stamp;
    std::shared_ptr<Question> question;
    Done done;
  };
  /// Makes the next seek. @returns whether there was one
  bool seekNext();
  void seek(Timestamp stamp);
  bool execute(bool isCycleDue);
  void execute(Given& given);
  void cycle(Timestamp due);
  void finishCycle();
  bool publishTruth();
  void publishLate();
  void measure(Timestamp wall);
  void fail(const std::string& why);
  bool isLive() const { return livePeriod_ > 0; }
  void refuseIfLive(const char* what) const;
  void follow(Timestamp looked);
  void halt(RobotId robot);
  void anchor(Timestamp wall);
  Timestamp latest() const;
  void remove(RobotId robot);
  void meetResidents();
  Client& client(ClientId id);

  ServedWorld& world_;
  const BoardConfig config_;
  std::function<void()> onCycle_;
  BoardClock clock_;

  mutable std::mutex mutex_;  ///< guards news_, orders_ and turns_
  std::condition_variable news_;
  std::map<ClientId, std::deque<Given>> orders_;  ///< orders to be executed, by client
  std::deque<ClientId> turns_;                    ///< these clients, the next one first
  std::atomic<bool> isStopped_{false};

  std::map<ClientId, Client> clients_;
  std::map<RobotId, Robot> robots_;
  std::vector<Message> told_;             ///< the world's readings that were last published
  std::shared_ptr<RobotReadings> truth_;  ///< readings of robot 0; null if the world has none
  RobotId lastRobot_ = 0;
  std::optional<std::uint64_t>
      residentsVersion_;                    ///< residentsVersion() at the last meetResidents()
  const Timestamp livePeriod_;              ///< see ServedWorld [us]
  std::map<RobotId, ClientId> commanders_;  ///< client that last commanded a live robot
  bool isPaused_ = false;
  std::uint64_t steps_ = 0;  ///< steps to be made although the world is paused
  Done stepsDone_;
  std::string failure_;
  double speed_;
  bool isFree_;
  bool wasBlocked_ = true;
  Timestamp anchorStamp_ = 0;
  Timestamp anchorWall_ = 0;
  Timestamp nextLook_ = 0;  ///< time of the next look at a live world, on the computer's clock [us]
  Timestamp cycle_ = 0;     ///< length of the last one on the world's clock [us]
  std::deque<Seek> seeks_;  ///< one a client, the next one first
  Timestamp nextSeek_ = 0;  ///< not before that, on the computer's clock [us]
  std::size_t executed_ = 0;    ///< orders since the last cycle
  Timestamp spent_ = 0;         ///< time spent on these orders [us]
  Timestamp measuredWall_ = 0;  ///< begin of the pace's measurement, on the computer's clock [us]
  Timestamp measuredStamp_ = 0;
  double achieved_ = 0.0;  ///< times real time, in the second before that

  std::atomic<std::uint64_t> cycles_{0};
  std::atomic<std::uint64_t> missed_{0};
  std::atomic<std::size_t> clientCount_{0};
  std::atomic<std::size_t> robotCount_{0};
};

/// "ERR code text" of the exception that is being handled.
std::string currentErrorText();

}  // namespace ortung::server
