#include "ortung/study/Cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr double kFar = 8.0;      ///< [m]
constexpr double kNearest = 0.5;  ///< least distance to be carried elsewhere at all [m]
constexpr double kBefore = 60.0;  ///< longest time that a kidnapped robot tracks before [s]
constexpr double kAfter = 300.0;  ///< longest time that it has to find its place [s]
/// Least time before the kidnap, or a quarter of the log [s].
constexpr double kLeastBefore = 20.0;
constexpr double kLeastAfter = 30.0;
constexpr double kLeastTime = 20.0;  ///< least time after waking up, or a quarter of the log [s]
constexpr double kShortest = 10.0;   ///< shortest log [s]
constexpr int kTries = 10000;

constexpr std::uint64_t kKidnaps = 0xCA5EULL << 32;  ///< streams apart from those of MCL
constexpr std::uint64_t kWakeUps = kKidnaps + 1;
constexpr std::uint64_t kTeleports = kKidnaps + 2;

using Truth = Recording::Truth;

/// Time steps with ground truth, found by time.
class Moments {
 public:
  explicit Moments(const Recording& recording) : recording_(recording) {
    if (truth().size() < 2 || duration() < kShortest)
      fail("has less than 10 s of ground truth (a feature of type groundTruth)");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(recording_.name() + ": " + what);
  }
  double duration() const { return toSeconds(truth().back().stamp - truth().front().stamp); }
  /// @param time since the first one
  const Truth& at(double seconds) const {
    const Timestamp stamp = truth().front().stamp + fromSeconds(seconds);
    const auto found = std::ranges::lower_bound(truth(), stamp, {}, &Truth::stamp);
    return found == truth().end() ? truth().back() : *found;
  }
  const Truth& random(double from, double to, Random& random) const {
    return at(random.uniform(from, to));
  }
  double seconds(const Truth& t) const { return toSeconds(t.stamp - truth().front().stamp); }
  /// Returns the index of the first message that comes @p seconds or more after the first time
  /// step.
  std::size_t endAt(double seconds) const {
    return seconds >= duration() ? recording_.messages().size() : at(seconds).message;
  }
  const std::vector<Truth>& truth() const { return recording_.truth(); }
  void requireFar() const {
    if (const double far = carriedFar(recording_); far < kNearest)
      fail("its ground truth spans so little that a robot could be carried " + std::to_string(far) +
           " m, expected at least 0.5 m");
  }

  /// Returns a random time step that is carriedFar() from another one and has @p after seconds
  /// behind it.
  const Truth* farFrom(const Truth& place, double after, Random& chance) const {
    const double least = carriedFar(recording_);
    for (int i = 0; i < kTries; ++i) {
      const Truth& there = random(0.0, duration() - after, chance);
      if (distance(there.pose, place.pose) >= least) return &there;
    }
    return nullptr;
  }

 private:
  const Recording& recording_;
};

}  // namespace

double carriedFar(const Recording& recording) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low[2] = {kInfinity, kInfinity};
  double high[2] = {-kInfinity, -kInfinity};
  for (const Truth& t : recording.truth()) {
    low[0] = std::min(low[0], t.pose.x);
    low[1] = std::min(low[1], t.pose.y);
    high[0] = std::max(high[0], t.pose.x);
    high[1] = std::max(high[1], t.pose.y);
  }
  if (recording.truth().empty()) return kFar;
  return std::min(kFar, std::hypot(high[0] - low[0], high[1] - low[1]) / 3.0);
}

std::shared_ptr<const Splice> kidnapped(const std::shared_ptr<const Recording>& recording,
                                        std::uint64_t seed) {
  const Moments moments(*recording);
  moments.requireFar();
  Random chance(seed, kKidnaps);
  const double before = std::min(kLeastBefore, moments.duration() / 4);
  const double after = std::min(kLeastAfter, moments.duration() / 4);
  for (int i = 0; i < 100; ++i) {
    const Truth& here = moments.random(before, moments.duration(), chance);
    const Truth* there = moments.farFrom(here, after, chance);
    if (there == nullptr) continue;
    const Truth& begin = moments.at(std::max(0.0, moments.seconds(here) - kBefore));
    const std::size_t end = moments.endAt(moments.seconds(*there) + kAfter);
    if (begin.message >= here.message || there->message >= end) continue;
    return std::make_shared<Splice>(
        recording, std::vector<Piece>{{begin.message, here.message}, {there->message, end}});
  }
  moments.fail("its ground truth has no two moments " + std::to_string(carriedFar(*recording)) +
               " m apart to carry the robot between");
}

std::shared_ptr<const Splice> wokenUp(const std::shared_ptr<const Recording>& recording,
                                      std::uint64_t seed, double travelled) {
  const Moments moments(*recording);
  Random chance(seed, kWakeUps);
  const double leastTime = std::min(kLeastTime, moments.duration() / 4);
  const double all = moments.truth().back().travelled;
  const double latest = moments.duration() - leastTime;
  const double mostTravelled = all - travelled;
  if (mostTravelled < 0.0)
    moments.fail("its ground truth has " + std::to_string(all) +
                 " m travelled, expected at least " + std::to_string(travelled) + " m");
  for (int i = 0; i < kTries; ++i) {
    const Truth& begin = moments.random(0.0, latest, chance);
    if (begin.travelled > mostTravelled) continue;
    return std::make_shared<Splice>(
        recording, std::vector<Piece>{{begin.message, recording->messages().size()}});
  }
  return std::make_shared<Splice>(recording, std::vector<Piece>{{0, recording->messages().size()}});
}

std::shared_ptr<const Splice> teleported(std::shared_ptr<const Recording> recording,
                                         std::uint64_t seed, double rate) {
  if (!(rate > 0.0)) throw std::invalid_argument("a rate of teleports is above 0");
  const Moments moments(*recording);
  moments.requireFar();
  Random chance(seed, kTeleports);
  std::vector<Piece> pieces;
  double left = moments.duration();
  const Truth* begin = &moments.truth().front();
  const double rest = std::min(kLeastAfter, moments.duration() / 4);
  while (begin != nullptr) {
    const double travelled = begin->travelled - std::log(1.0 - chance.uniform()) / rate;
    const auto reached =
        std::ranges::lower_bound(moments.truth(), travelled, {}, &Truth::travelled);
    const double end = reached == moments.truth().end()
                           ? moments.duration()
                           : std::max(moments.seconds(*reached), moments.seconds(*begin) + rest);
    const double seconds = end - moments.seconds(*begin);
    const bool isLast = end >= moments.duration() || seconds + rest >= left;
    const double until = isLast ? moments.seconds(*begin) + left : end;
    pieces.push_back({begin->message, moments.endAt(until)});
    left -= seconds;
    begin = isLast ? nullptr : moments.farFrom(moments.at(end), rest, chance);
  }
  return std::make_shared<Splice>(std::move(recording), std::move(pieces));
}

}  // namespace ortung
