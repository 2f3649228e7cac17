// Stamps of readings in the client's clock, with clocks and a network of the test's own.
#include <gtest/gtest.h>

#include <deque>
#include <mutex>

#include "Files.hpp"
#include "ScriptedServer.hpp"
#include "ortung/client/RemoteRobot.hpp"

namespace ortung::test {
namespace {

/// A client and a server with clocks that tick when the test says so: the server's is 1 hour ahead,
/// and each exchange takes as long on its way there and back as the test has planned.
class TwoClocks {
 public:
  static constexpr Timestamp kAhead = 3'600'000'000;
  struct Trip {
    Timestamp there;  ///< [us]
    Timestamp back;   ///< [us]
  };

  explicit TwoClocks(std::deque<Trip> trips)
      : trips_(std::move(trips)),
        server_([this](const std::string& request) { return answer(request); }) {}

  RemoteOptions options() {
    RemoteOptions options;
    options.session.port = server_.port();
    options.cycle = 0.0;
    options.clock = [this] { return now(); };
    return options;
  }
  Timestamp now() const {
    const std::lock_guard lock(mutex_);
    return ours_;
  }
  void pass(Timestamp time) {
    const std::lock_guard lock(mutex_);
    ours_ += time;
  }
  std::size_t exchanges() const {
    const std::lock_guard lock(mutex_);
    return exchanges_;
  }

 private:
  std::string answer(const std::string& request) {
    const std::lock_guard lock(mutex_);
    const std::string server = std::to_string(kAhead + ours_);
    if (request == "UPDATE")
      return "OK UPDATE robot=1 now=" + server + " lines=1\n" + server +
             " odometry/odometry/pose 5 2147483648 2147483648 18000 2147483648 2147483648";
    if (request != "TIME") return "";
    ++exchanges_;
    const Trip trip = trips_.front();
    if (trips_.size() > 1) trips_.pop_front();
    const std::string received = std::to_string(kAhead + (ours_ += trip.there));
    ours_ += trip.back;
    return "OK TIME received=" + received + " sent=" + received;
  }

  mutable std::mutex mutex_;
  Timestamp ours_ = 1'000'000;
  std::size_t exchanges_ = 0;
  std::deque<Trip> trips_;
  ScriptedServer server_;
};

class Stamps : public testing::Test {
 protected:
  void SetUp() override {
    file = folder / "robot.toml";
    writeBytes(file, "[[sensor]]\nplugin = \"odometry\"\n");
  }
  static Timestamp stampOf(RemoteRobot& robot) {
    EXPECT_TRUE(robot.update()) << robot.trouble();
    const auto lock = robot.container().read();
    return robot.container().find({.type = "odometry"})->stamp();
  }
  TemporaryFolder folder;
  std::filesystem::path file;
};

TEST_F(Stamps, AConnectionsFirstExchangesAreEnoughToForgetTheSlowOnes) {
  // What a new connection begins with is slow, on one of its ways: alone it tells our time at a
  // moment of the server's 250 ms too early.
  TwoClocks clocks({{500'000, 0}, {400'000, 0}, {300'000, 0}, {100, 100}});
  RemoteRobot robot(file, clocks.options());
  EXPECT_GE(clocks.exchanges(), 4u);
  const Timestamp truth = clocks.now();
  EXPECT_NEAR(static_cast<double>(stampOf(robot)), static_cast<double>(truth), 110.0);
  EXPECT_LE(robot.clockOffset().bound(TwoClocks::kAhead + truth), 1000.0);
}

TEST_F(Stamps, DoNotGoBackWhenTheClocksAreKnownBetter) {
  // All first exchanges are slow on their way back, so stamps come 5 ms late; a later one is quick.
  std::deque<TwoClocks::Trip> trips(8, {0, 10'000});
  trips.push_back({10, 10});
  TwoClocks clocks(std::move(trips));
  RemoteRobot robot(file, clocks.options());
  clocks.pass(999'000);
  const Timestamp before = stampOf(robot);
  EXPECT_NEAR(static_cast<double>(before - clocks.now()), 5'000.0, 500.0);
  clocks.pass(1'000);  // a second after the first ones the clocks are compared again
  const Timestamp after = stampOf(robot);
  EXPECT_GT(before, clocks.now());  // what the clocks alone say now is less than was said already
  EXPECT_EQ(after, before);
  clocks.pass(20'000);
  EXPECT_NEAR(static_cast<double>(stampOf(robot)), static_cast<double>(clocks.now()), 500.0);
}

}  // namespace
}  // namespace ortung::test
