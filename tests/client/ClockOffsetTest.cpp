#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ortung/base/Random.hpp"
#include "ortung/client/ClockOffset.hpp"

namespace ortung {
namespace {

/// Two clocks that disagree and a network that is slow by chance, more so in one direction.
struct Network {
  double offset = 1e9;  ///< of the server's clock [us]
  double rate = 1.0;    ///< the server's seconds for each of ours
  double truth = 5e8;   ///< our time [us]
  Random random{42};

  Timestamp ours() const { return static_cast<Timestamp>(std::floor(truth)); }
  double serverTime() const { return offset + truth * rate; }
  Timestamp servers() const { return static_cast<Timestamp>(std::floor(serverTime())); }
  void pass(double least, double mean) { truth += least - mean * std::log(1.0 - random.uniform()); }

  ClockOffset::Exchange exchange() {
    ClockOffset::Exchange e;
    e.sent = ours();
    pass(50.0, 900.0);
    e.received = servers();
    pass(5.0, 20.0);
    e.answered = servers();
    pass(50.0, 150.0);
    e.back = ours();
    return e;
  }
};

/// Half of what an exchange spent on the network.
double halfTrip(const ClockOffset::Exchange& e) {
  return static_cast<double>((e.back - e.sent) - (e.answered - e.received)) / 2.0;
}

TEST(ClockOffset, TheErrorIsBelowHalfOfTheShortestRoundTrip) {
  Network network;
  ClockOffset clock;
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 50; ++i) {
    const auto exchange = network.exchange();
    shortest = std::min(shortest, halfTrip(exchange));
    clock.add(exchange);
    const double error = static_cast<double>(clock.toLocal(network.servers())) - network.truth;
    EXPECT_LT(std::abs(error), shortest + 2.0) << i;  // stamps are whole microseconds
  }
  EXPECT_LT(shortest, 200.0);  // the network has good moments, and they were found
}

TEST(ClockOffset, DriftIsFollowedAndTheErrorStaysWithinTheBound) {
  for (const double drift : {-200e-6, 80e-6, 250e-6}) {
    Network network;
    network.rate = 1.0 + drift;
    ClockOffset clock;
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
      clock.add(network.exchange());
      network.truth += 1e6;  // once a second
      const double error =
          std::abs(static_cast<double>(clock.toLocal(network.servers())) - network.truth);
      EXPECT_LE(error, clock.bound(network.servers()) + 2.0) << i;
      if (i > 100) worst = std::max(worst, error);
    }
    EXPECT_NEAR(clock.rate(), 1.0 / network.rate, 40e-6);
    // Half of a typical round trip; without drift it would be up to 16 ms after 64 s.
    EXPECT_LT(worst, 500.0);
  }
}

TEST(ClockOffset, AWorldAtAnotherSpeedHasAnotherRate) {
  Network network;
  network.rate = 5.0;
  ClockOffset clock;
  for (int i = 0; i < 10; ++i) {
    clock.add(network.exchange());
    network.truth += 5e5;
  }
  EXPECT_NEAR(clock.rate(), 0.2, 1e-3);
  const double error = static_cast<double>(clock.toLocal(network.servers())) - network.truth;
  EXPECT_LE(std::abs(error), clock.bound(network.servers()) + 2.0);
}

TEST(ClockOffset, AClockThatWasSetIsMeasuredAnew) {
  Network network;
  ClockOffset clock;
  for (int i = 0; i < 20; ++i) clock.add(network.exchange());
  network.offset -= 3e7;  // the world was reset
  const auto exchange = network.exchange();
  clock.add(exchange);
  const double error = static_cast<double>(clock.toLocal(network.servers())) - network.truth;
  EXPECT_LT(std::abs(error), halfTrip(exchange) + 2.0);
}

// What was measured before a clock was set says nothing of it, however good it was: of two such
// exchanges no rate comes that a world could have.
TEST(ClockOffset, OfAClockThatWasSetOnlyTheNewestExchangeCounts) {
  const auto expectOneReading = [](Timestamp set, const char* how) {
    ClockOffset clock;
    clock.add({0, 5'000'000, 5'000'000, 20});  // a good one
    constexpr Timestamp kLater = 2'000'000;
    const Timestamp server = 5'000'000 + kLater + set;
    clock.add({kLater - 2'000, server, server, kLater + 2'000});  // a bad one, of another clock
    EXPECT_EQ(clock.rate(), 1.0) << how;
    for (const Timestamp after : {0, 10'000, 1'000'000})
      EXPECT_NEAR(static_cast<double>(clock.toLocal(server + after)),
                  static_cast<double>(kLater + after), 1.0)
          << how;
  };
  expectOneReading(-2'100'000, "back to before the first exchange");
  expectOneReading(-1'999'000, "back to a little after it: 2000 times slower");
  expectOneReading(4'000'000'000, "far ahead: 2000 times faster");
}

TEST(ClockOffset, ANetworkThatTakesNoTimeLeavesTheRoundingOfStamps) {
  ClockOffset clock;
  clock.add({1'000, 50'000, 50'010, 1'010});  // all of it passed at the server
  EXPECT_LE(clock.bound(50'005), 1.0);        // [us], as stamps are whole ones
  EXPECT_GT(clock.bound(50'005), 0.0);
  EXPECT_EQ(clock.toLocal(50'005), 1'005);
}

TEST(ClockOffset, NonsenseIsPassedOver) {
  ClockOffset clock;
  clock.add({100, 50, 60, 90});   // back before sent
  clock.add({100, 60, 50, 190});  // answered before received
  EXPECT_FALSE(clock.isKnown());
}

TEST(ClockOffset, StampsAtTheEndsOfTimeDoNotOverflow) {
  constexpr Timestamp kFirst = std::numeric_limits<Timestamp>::min();
  constexpr Timestamp kLast = std::numeric_limits<Timestamp>::max();
  ClockOffset clock;
  clock.add({0, kFirst, kLast, 10});
  ASSERT_TRUE(clock.isKnown());
  clock.add({1'000, kFirst, kFirst, 1'010});
  EXPECT_LT(clock.toLocal(kFirst), 2'000);
  EXPECT_GT(clock.toLocal(kLast), 1'000'000'000'000'000'000);  // in 2^64 us, or as late as can be
  clock.add({kFirst, 0, 10, kLast});
  EXPECT_TRUE(std::isfinite(clock.bound(kFirst)) && std::isfinite(clock.bound(kLast)));

  // It does not stay confused.
  Network network;
  for (int i = 0; i < 5; ++i) clock.add(network.exchange());
  const double error = static_cast<double>(clock.toLocal(network.servers())) - network.truth;
  EXPECT_LT(std::abs(error), 1000.0);
}

}  // namespace
}  // namespace ortung
