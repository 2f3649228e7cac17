#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/mcl_served/LocalizedRobots.hpp"
#include "ortung/robot/RobotTables.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung {

/// Gives a robot its tables, learned or read; null if @p goOn, called with the share that is
/// done, has returned false. Called on the threads of filters. @throws std::exception, whose text
/// clients get
using TableGiver = std::function<std::shared_ptr<const RobotTables>(
    const Robot& robot, const std::function<bool(double)>& goOn)>;

/// Localizes one robot by given readings, on a thread of its own, which also waits for the tables.
/// The caller of take() never waits: where the filter lags behind, it sets one time step after the
/// other and updates once; where it lags far behind, time steps are lost, and the oldest orders.
/// Thread-safe.
class ORTUNG_API FilterThread {
 public:
  /// Which robot is localized, and by which tables.
  struct Config {
    std::filesystem::path robot;  ///< its file
    TableGiver tables;
    std::uint64_t seed = 1;
  };
  static constexpr std::size_t kMostMoments = 256;  ///< time steps that may wait

  /// Off at first.
  explicit FilterThread(Config config);
  ~FilterThread();  ///< waits for an update, or a step of learning
  FilterThread(const FilterThread&) = delete;
  FilterThread& operator=(const FilterThread&) = delete;

  /// Adds readings of one time step; those of features that the filter does not use are left out.
  void take(std::span<const Message> moment);
  /// @throws ServeError for a place where the robot can't stand, if the field is known already
  void order(const LocalizationOrder& order);
  /// Time and odometry have begun anew: so does the filter, if it is on, with the tables it has.
  void restart();
  /// Whether clients read the samples, which are published only then.
  void wantSamples(bool wanted);

  /// How far the localization is.
  LocalizationState state() const;
  /// Null unless it is searching or running.
  std::shared_ptr<const Robot> perceiver() const;
  /// What the filter looks at, directly or through extractors; none while that is not known.
  std::vector<SensorId> needs() const;
  /// Appends what is published and was not taken yet: the newest of each feature.
  void takePublished(std::vector<Message>& out);

  /// Begins to end; isOver() says when the destructor will not wait.
  void requestStop();
  bool isOver() const { return isOver_; }

 private:
  using Order = LocalizationOrder;
  using Moment = std::vector<Message>;  ///< readings of one time step
  struct Restart {};
  /// What other threads have given and this one has not taken yet. All of it keeps its turn: a
  /// place is where the robot is when it is told.
  using Inbox = std::deque<std::variant<Moment, Order, Restart>>;
  /// Adds to the inbox; drops the oldest of the same kind if there are @p most of them.
  template <typename Given>
  void give(Given given, std::size_t most);
  /// Body of the thread: waits for the inbox, executes orders, and localizes.
  void run(const std::stop_token& stop);
  /// Waits until there is something to do, and takes it; nothing when the thread is to end.
  std::optional<Inbox> await(const std::stop_token& stop);
  void obey(const Order& order, const std::stop_token& stop);
  /// Learns or reads the tables if there are none yet, then opens the filter.
  void start(const Order& order, const std::stop_token& stop);
  /// Creates a filter with a belief about @p start, and publishes its features.
  void open(const LocalizationStart& start);
  /// Destroys the filter. Orders that wait count more than @p state: none fails while it is off,
  /// and what is to be on again is not off.
  void close(LocalizationState state);
  /// Takes out of the inbox what was given, in its order: sets the readings of time steps, obeys
  /// orders, and updates the filter once before each order and at the end.
  void take(Inbox& inbox, const std::stop_token& stop);
  /// Updates the filter if there are readings, and tells what is new.
  void localize(bool hasReadings);
  /// Copies new readings of the filter's features for takePublished().
  void publish();
  /// Sets the state unless the filter was switched off meanwhile.
  void set(LocalizationState state);

  const Config config_;
  // For the thread alone.
  std::shared_ptr<const RobotTables> tables_;
  std::shared_ptr<Localization> localization_;  ///< null: off
  /// A feature of the filter that is published.
  struct Output {
    const SensorData* data;
    std::uint64_t seen;  ///< sequence number of the reading last published
  };
  std::vector<Output> outputs_;

  mutable std::mutex mutex_;  ///< guards the members from here to wantsSamples_
  std::condition_variable_any news_;
  Inbox inbox_;
  LocalizationState state_;
  std::shared_ptr<Localization> perceiver_;
  std::vector<SensorId> needs_;
  std::vector<Message> published_;  ///< newest reading of each feature that was not taken yet
  bool wantsSamples_ = false;

  std::atomic<bool> isWanted_ = false;  ///< whether the last order switched it on
  std::atomic<bool> isOver_ = false;
  std::jthread thread_;  ///< last, so that it ends before what it uses
};

}  // namespace ortung
