// Whatever features answer and clocks say: the belief stays one, and good readings bring it back.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "FakeRun.hpp"
#include "Resampling.hpp"
#include "Seeded.hpp"
#include "Told.hpp"

namespace ortung {
namespace {

using test::FakeRun;
using test::kPi;
using test::Told;
using Words = std::vector<std::uint32_t>;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kShare = 20;  ///< sanitizers are slower by so much
#else
constexpr int kShare = 1;
#endif

constexpr Timestamp kFarthest = Timestamp{1} << 60;  ///< as far as FrameReader takes readings
const SensorId kScanner{"LMS200", "LRF", "scan"};
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// What may go wrong, each as a bit.
enum Poison : unsigned {
  kAnswers = 1,    ///< a feature answers nonsense
  kOdometry = 2,   ///< counters jump anywhere
  kWords = 4,      ///< readings say anything that is let through
  kFrozen = 8,     ///< the words before, with a new stamp
  kLate = 16,      ///< stamps of up to 10 s ago; some twice, and in any order
  kClock = 32,     ///< the clock is set anywhere
  kKidnap = 64,    ///< the robot is elsewhere
  kNothing = 128,  ///< nothing comes
  kNoOdometry = 256,
  kFar = 512,  ///< one feature's clock alone is wrong by far
  kAll = 1023,
};

/// Range in the room with one corner rounded: so it does not look the same after half a turn.
double rangeTo(const test::Room& room, const Pose2& sensor, double angle) {
  constexpr double kRadius = 1.1;
  const double dx = room.width / 2 - sensor.x;
  const double dy = room.height / 2 - sensor.y;
  const double along = dx * std::cos(angle) + dy * std::sin(angle);
  const double beside = dy * std::cos(angle) - dx * std::sin(angle);
  const double wall = room.range(sensor.x, sensor.y, angle);
  if (along <= 0.0 || std::abs(beside) >= kRadius) return wall;
  return std::min(wall, along - std::sqrt(kRadius * kRadius - beside * beside));
}

/// The room's robot, with a feature of foreign make.
class PoisonedRun {
 public:
  PoisonedRun()
      : evil_(static_cast<Told&>(run_.container.add(std::make_unique<Told>(
            "evil", [](const SampleView&, std::size_t) { return -1.0F; })))) {
    test::learnEverywhere(*run_.container.findExactly(kScanner), run_.region, kPi / 90,
                          [this](const Pose2& s) { return scanWords(s, nullptr); });
  }

  FakeRun& run() { return run_; }

  /// The run begins anew, all features with a reading of the same moment.
  void begin(std::uint64_t seed) {
    random_ = Random(seed);
    lastScan_.clear();
    run_.stamp = fromSeconds(1000);
    run_.begin(anywhere(), seed);
    run_.tellsOdometry = true;
    driveWell();
    answer([](const SampleView&, std::size_t) { return -1.0F; });
    tellEvil(run_.stamp);
  }

  /// One period in which what @p poison permits goes wrong.
  void drive(unsigned poison) {
    run_.tellsOdometry = (poison & kNoOdometry) == 0;
    if (is(poison, kClock, 0.05)) setClock();
    if (is(poison, kKidnap, 0.02)) run_.truth = anywhere();
    if (is(poison, kNothing, 0.1)) return;
    driveWell();
    if (is(poison, kAnswers, 0.5)) answerNonsense();
    tellEvil(run_.stamp);
    if (is(poison, kOdometry, 0.1)) tellOdometry();
    if (is(poison, kWords, 0.2)) tellScan(anyWords(run_.scan.beams));
    if (is(poison, kFrozen, 0.5)) tellScan(lastScan_);
    if (is(poison, kLate, 0.3)) tellAgain(run_.stamp - fromSeconds(random_.uniform(0.0, 10.0)));
    if (is(poison, kFar, 0.02)) tellAgain(anyStamp());
    lastScan_ = wordsOf(kScanner);
  }

  void tellEvil(Timestamp stamp) { run_.container.set({stamp, evil_.id(), {}}); }
  /// One period in which all is well but what was told before.
  void driveWell() {
    run_.drive();
    tellScan(scanWords(run_.truth * Pose2{0.1, 0, 0}, &random_));
  }
  Timestamp anyStamp() {
    const Timestamp stamps[] = {kFarthest, -kFarthest, 0, run_.stamp + 200000, run_.stamp - 100000};
    return stamps[random_.below(std::size(stamps))];
  }
  Pose2 anywhere() {
    return FakeRun::onCircle(random_.uniform(-1.5, 1.5), random_.uniform(-0.5, 0.5),
                             random_.uniform(-kPi, kPi));
  }

 private:
  bool is(unsigned poison, Poison one, double share) {
    return random_.uniform() < share && (poison & one) != 0;
  }
  void answer(Told::Answer a) { evil_.answer = std::move(a); }
  void tellScan(const Words& words) {
    if (!words.empty()) run_.container.set({run_.stamp, kScanner, words});
  }
  Words scanWords(const Pose2& sensor, Random* noise) const {
    std::vector<float> ranges;
    for (int i = 0; i < run_.scan.beams; ++i) {
      const double angle = sensor.theta + run_.scan.firstAngle + i * run_.scan.angleStep;
      const double error = noise ? 0.02 * noise->gaussian() : 0.0;
      ranges.push_back(static_cast<float>(rangeTo(run_.room, sensor, angle) + error));
    }
    Words words;
    ScanData::encode(ranges, run_.scan.maxRange, words);
    return words;
  }
  Words wordsOf(const SensorId& id) const {
    const auto words = run_.container.findExactly(id)->getData();
    return {words.begin(), words.end()};
  }
  std::uint32_t anyWord() {
    const std::uint32_t words[] = {0, 1, 3000, 1U << 31, ~0U, random_.next()};
    return words[random_.below(std::size(words))];
  }
  Words anyWords(int n) {
    Words words(static_cast<std::size_t>(n), anyWord());
    if (random_.uniform() < 0.5)
      std::generate(words.begin(), words.end(), [&] { return anyWord(); });
    return words;
  }

  void answerNonsense() {
    const float values[] = {kNan, -kInfinity, kInfinity, -3e38F, 3e38F, 0.0F, -1.0F, -1e4F};
    const float one = values[random_.below(std::size(values))];
    const float other = values[random_.below(std::size(values))];
    const Pose2 place = anywhere();
    const auto kind = random_.below(3);
    answer([=](const SampleView& poses, std::size_t i) {
      if (kind == 0) return one;
      if (kind == 1) return i % 2 ? one : other;
      // Elsewhere, and very sure of it.
      const double off = std::hypot(static_cast<double>(poses.x[i]) - place.x,
                                    static_cast<double>(poses.y[i]) - place.y);
      return static_cast<float>(-0.5 * off * off / 1e-4);
    });
  }

  void tellOdometry() {
    Words words = {anyWord(), anyWord(), static_cast<std::uint32_t>(random_.below(36001)),
                   anyWord(), anyWord()};
    if (random_.uniform() < 0.3) words.insert(words.end(), {anyWord(), ~0U, anyWord()});
    try {
      run_.container.set({run_.stamp, {"base", "odometry", "pose"}, words});
    } catch (const std::invalid_argument&) {  // the feature refuses them
    }
  }

  /// One of the features once more, with another stamp; or twice.
  void tellAgain(Timestamp stamp) {
    const SensorId ids[] = {
        {"base", "odometry", "pose"}, kScanner, {"cam", "camera", "posts"}, evil_.id()};
    const SensorId& id = ids[random_.below(std::size(ids))];
    const Words words = wordsOf(id);
    if (run_.container.findExactly(id)->sequence() == 0) return;
    run_.container.set({stamp, id, words});
    if (random_.uniform() < 0.5) run_.container.set({stamp, id, words});
  }

  void setClock() {
    const Timestamp now = run_.stamp;
    const Timestamp stamps[] = {kFarthest - fromSeconds(1000),
                                -kFarthest,
                                0,
                                now + fromSeconds(1e6),
                                now - fromSeconds(1e6),
                                now - fromSeconds(4.9),
                                now - fromSeconds(5.3),
                                now + fromSeconds(60)};
    const Timestamp farthest = kFarthest - fromSeconds(1000);
    run_.stamp = std::clamp(stamps[random_.below(std::size(stamps))], -kFarthest, farthest);
  }

  FakeRun run_;
  Told& evil_;
  Random random_{1};
  Words lastScan_;
};

/// Learned once; every case begins anew.
PoisonedRun& poisoned() {
  static PoisonedRun one;
  return one;
}

/// What is wrong with an estimate; empty: nothing.
std::string wrongWith(const PoseEstimate& e) {
  if (!isFinite(e.pose)) return "pose";
  if (!(e.share >= 0.0 && e.share <= 1.0 + 1e-9)) return "share " + std::to_string(e.share);
  for (const double c : e.covariance)
    if (!std::isfinite(c)) return "covariance";
  for (const std::size_t k : {0U, 4U, 8U})
    if (e.covariance[k] < 0.0) return "variance";
  return "";
}

std::string wrongWith(const Mcl& mcl, const MclConfig& config, Timestamp asked) {
  const SampleSet& set = mcl.samples();
  if (set.size() == 0 || set.size() > 2 * config.maxSamples + 2000)
    return std::to_string(set.size()) + " samples";
  for (const auto* values : {&set.x, &set.y, &set.theta, &set.logWeight})
    for (const float v : *values)
      if (!std::isfinite(v)) return "a sample";
  const auto weights = normalized(set.logWeight);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(std::abs(sum - 1.0) < 1e-6)) return "sum of weights " + std::to_string(sum);
  if (!std::all_of(weights.begin(), weights.end(), [](double w) { return w >= 0.0 && w <= 1.0; }))
    return "weights";
  const auto then = mcl.estimate(asked);
  if (then && then->stamp != asked) return "stamp";
  const std::string carriedOn = then ? wrongWith(*then) : "";
  return carriedOn.empty() ? wrongWith(mcl.estimate()) : "estimate(stamp): " + carriedOn;
}

void startAnyhow(Mcl& mcl, PoisonedRun& run, std::uint64_t how) {
  if (how % 4 == 0)
    mcl.startGlobal();
  else if (how % 4 == 1)
    mcl.startAt({1e6, -1e6, 3.0}, 0.5, 0.1);  // off the map
  else if (how % 4 == 2)
    mcl.startAt({1.0, 0.5, 1.0}, 0.0, 0.0);
  else
    mcl.startAt(run.run().truth, 0.2, 0.1);
}

/// Updates until something is wrong, which it returns.
std::string drivePoisoned(const MclConfig& config, unsigned poison, std::uint64_t seed, int steps) {
  PoisonedRun& run = poisoned();
  run.begin(seed);
  const auto mcl = run.run().mcl(config);
  startAnyhow(*mcl, run, seed);
  const SensorContainer empty;
  for (int i = 0; i < steps; ++i) {
    run.drive(poison);
    mcl->update(i % 50 == 49 ? empty : run.run().container);
    const std::string wrong = wrongWith(*mcl, config, run.anyStamp());
    if (!wrong.empty()) return wrong + " after update " + std::to_string(i);
  }
  return "";
}

MclConfig fewSamples(int most) {
  MclConfig config;
  config.maxSamples = static_cast<std::size_t>(most);
  config.minSamples = std::max<std::size_t>(1, config.maxSamples / 4);
  config.startCandidates = 1;
  config.recoverSlow = 0.0;
  return config;
}

// 100 cases each.
RC_GTEST_PROP(Poison, LeavesABeliefWhateverComes, ()) {
  MclConfig config = fewSamples(*rc::gen::inRange(1, 60));
  config.resampleBelow = *rc::gen::element(0.0, 0.5, 1.0);
  const auto poison = *rc::gen::inRange(0U, unsigned{kAll} + 1);
  const auto seed = *rc::gen::inRange(0, 1 << 30);
  const int steps = *rc::gen::inRange(900, 1101) / kShare;
  const std::string wrong = drivePoisoned(config, poison, static_cast<std::uint64_t>(seed), steps);
  if (!wrong.empty()) RC_FAIL(wrong);
}

// Other places are looked for all the time, which costs.
RC_GTEST_PROP(Poison, LeavesABeliefThatIsComparedWithOthers, ()) {
  MclConfig config = fewSamples(*rc::gen::element(1, 20, 400));
  config.recoverSlow = *rc::gen::element(0.01, 1.0);
  const auto poison = *rc::gen::inRange(0U, unsigned{kAll} + 1);
  const auto seed = *rc::gen::inRange(0, 1 << 30);
  const std::string wrong =
      drivePoisoned(config, poison, static_cast<std::uint64_t>(seed), 20 / std::min(kShare, 4));
  if (!wrong.empty()) RC_FAIL(wrong);
}

TEST(Poison, LeavesABeliefOfManySamples) {
  for (const int samples : {20000, 1000000 / kShare}) {
    MclConfig config = fewSamples(samples);
    config.threads = 2;
    for (std::uint64_t seed = 0; seed < (samples > 20000 ? 1 : 4); ++seed)
      EXPECT_EQ(drivePoisoned(config, kAll & ~unsigned{kNothing}, seed, samples > 20000 ? 4 : 10),
                "")
          << samples << ", seed " << seed;
  }
}

/// Good readings until the robot has been right for 1 s, -1: never.
int readingsUntilRight(Mcl& mcl, PoisonedRun& run, int most) {
  int right = 0;
  for (int i = 0; i < most; ++i) {
    run.driveWell();
    mcl.update(run.run().container);
    right = distance(mcl.estimate().pose, run.run().truth) < 0.5 ? right + 1 : 0;
    if (right == 10) return i - 8;
  }
  return -1;
}

TEST(Poison, OneStampOfTheFarFutureDoesNotBlindTheOthers) {
  for (const Timestamp ahead : {fromSeconds(60), fromSeconds(1e6), kFarthest / 2}) {
    PoisonedRun& run = poisoned();
    run.begin(3);
    const auto mcl = run.run().mcl(fewSamples(500));
    mcl->startAt(run.run().truth, 0.2, 0.1);
    ASSERT_GE(readingsUntilRight(*mcl, run, 20), 0);
    run.tellEvil(run.run().stamp + ahead);
    run.driveWell();
    mcl->update(run.run().container);
    int weighed = 0;
    for (int i = 0; i < 100; ++i) {
      run.driveWell();
      weighed += mcl->update(run.run().container) ? 1 : 0;
    }
    EXPECT_GE(weighed, 60) << toSeconds(ahead) << " s ahead";
    EXPECT_LT(distance(mcl->estimate().pose, run.run().truth), 0.5) << toSeconds(ahead);
  }
}

RC_GTEST_PROP(Poison, IsForgottenWhenGoodReadingsCome, ()) {
  PoisonedRun& run = poisoned();
  MclConfig config;
  config.maxSamples = 1000;
  config.startCandidates = 20;
  const auto poison = *rc::gen::inRange(0U, unsigned{kAll} + 1);
  const auto seed = static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << 30));
  if (kShare > 1 && seed % 8 != 0) return;
  config.seed = seed;
  run.begin(seed);
  const auto mcl = run.run().mcl(config);
  startAnyhow(*mcl, run, seed);
  for (int i = 0; i < 40; ++i) {
    run.drive(poison);
    mcl->update(run.run().container);
  }
  run.run().tellsOdometry = true;
  // At most 171 in 600 cases.
  RC_ASSERT(readingsUntilRight(*mcl, run, 300) >= 0);
}

}  // namespace
}  // namespace ortung
