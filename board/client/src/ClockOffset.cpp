#include "ortung/client/ClockOffset.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ortung {
namespace {

constexpr std::size_t kMostReadings = 64;
// Two clocks of ordinary computers differ by less; it counts until their rate has been measured.
constexpr double kClockDrift = 300e-6;
// Speed of the server's world, at most; slower than the inverse it is not either.
constexpr double kFastest = 1000.0;
// What time stamps in whole microseconds lose.
constexpr double kRounding = 1.0;  // [us]
// Of a time stamp that is told, whatever the server's are: a double that a Timestamp can hold.
constexpr double kFarthest = 9.2e18;  // [us]

/// @pre @p from <= @p to; the difference of time stamps may be more than a time stamp can hold.
double span(Timestamp from, Timestamp to) {
  return static_cast<double>(static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from));
}

}  // namespace

double ClockOffset::errorAt(const Reading& reading, double server) const {
  return reading.error + rateError_ * std::abs(server - reading.server);
}

const ClockOffset::Reading& ClockOffset::best(double server) const {
  return *std::min_element(
      readings_.begin(), readings_.end(),
      [&](const Reading& a, const Reading& b) { return errorAt(a, server) < errorAt(b, server); });
}

void ClockOffset::add(const Exchange& exchange) {
  if (exchange.back < exchange.sent || exchange.answered < exchange.received) return;
  const double trip = span(exchange.sent, exchange.back);
  const double hold = span(exchange.received, exchange.answered);
  const Reading reading{
      (static_cast<double>(exchange.sent) + static_cast<double>(exchange.back)) / 2.0,
      (static_cast<double>(exchange.received) + static_cast<double>(exchange.answered)) / 2.0,
      std::max(trip - hold * rate_, 0.0) / 2.0 + kRounding};
  if (isKnown()) {
    const Reading& known = best(reading.server);
    const double expected = known.local + (reading.server - known.server) * rate_;
    const double permitted = errorAt(known, reading.server) + reading.error;
    if (std::abs(reading.local - expected) > permitted) startOver(reading);
  }
  readings_.push_back(reading);
  if (readings_.size() > kMostReadings) readings_.pop_front();
  estimateRate();
}

/// The server's clock was set, or runs at another speed since a while: in that case the last
/// reading and this one tell which.
void ClockOffset::startOver(const Reading& reading) {
  const Reading last = readings_.back();
  readings_.clear();
  const double rate = (reading.local - last.local) / (reading.server - last.server);
  if (rate > 1.0 / kFastest && rate < kFastest) readings_.push_back(last);
}

/// From the best reading of the older half and the best of the newer one.
void ClockOffset::estimateRate() {
  rate_ = 1.0;
  rateError_ = kClockDrift;
  if (readings_.size() < 2) return;
  const auto middle = readings_.begin() + static_cast<std::ptrdiff_t>(readings_.size() / 2);
  const auto lessError = [](const Reading& a, const Reading& b) { return a.error < b.error; };
  const Reading& before = *std::min_element(readings_.begin(), middle, lessError);
  const Reading& after = *std::min_element(middle, readings_.end(), lessError);
  const double span = after.server - before.server;
  if (span <= 0.0) return;
  const double measured = (after.local - before.local) / span;
  const double error = (before.error + after.error) / span;
  // A server at another speed than real time shows at once; one in real time must earn our trust.
  if (error < kClockDrift || std::abs(measured - 1.0) > error + kClockDrift) {
    rate_ = measured;
    rateError_ = error;
  }
}

Timestamp ClockOffset::toLocal(Timestamp server) const {
  const auto time = static_cast<double>(server);
  const Reading& reading = best(time);
  const double local = reading.local + (time - reading.server) * rate_;
  return static_cast<Timestamp>(std::llround(std::clamp(local, -kFarthest, kFarthest)));
}

double ClockOffset::bound(Timestamp server) const {
  const auto time = static_cast<double>(server);
  return errorAt(best(time), time);
}

}  // namespace ortung
