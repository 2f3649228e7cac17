// What a running localization is told from outside, and its belief across restarts.
#include <cmath>
#include <fstream>

#include "RoomRun.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/run/FoundChanges.hpp"
#include "ortung/run/Published.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung::test {
namespace {

using Told = RoomRun;

TEST_F(Told, APoseWithItsCovariance) {
  LocalizationConfig truthless = config();
  truthless.start.kind = LocalizationStart::Kind::kTruth;
  Localization localization(truthless);
  EXPECT_FALSE(localization.estimate(0));
  localization.setPose({0.8, 0.1, 1.5}, {0.04, 0, 0, 0, 0.04, 0, 0, 0, 0.02});
  EXPECT_TRUE(localization.isStarted()) << "nobody waits for the truth any more";
  ASSERT_TRUE(localization.estimate(0));
  EXPECT_NEAR(localization.estimate(0)->pose.x, 0.8, 0.05);
  for (const auto& moment : moments) {
    localization.container().set(std::span(moment).first(2));
    localization.update();
  }
  EXPECT_LT(distance(localization.mcl().estimate().pose, truth), 0.15);
}

// A robot or a world that stands may bring no reading for long.
TEST_F(Told, IsPublishedWithoutWaitingForAReading) {
  LocalizationConfig publishing = config();
  publishing.publish = true;
  Localization localization(publishing);
  for (const auto& moment : moments) {
    localization.container().set(std::span(moment).first(2));
    localization.update();
  }
  const SensorContainer& container = localization.container();
  const Timestamp now = moments.back()[0].stamp;
  const Pose2 told{-0.5, 0.5, 1};
  localization.setPose(told, {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4});
  const auto poses = container.get<PoseFixData>({"mcl", "LOCALIZATION", "pose"});
  ASSERT_TRUE(poses);
  ASSERT_EQ(poses->size(), 1U);
  EXPECT_LT(distance((*poses)[0].pose, told), 0.02);
  EXPECT_NEAR((*poses)[0].pose.theta, told.theta, 0.02);
  EXPECT_EQ(container.find({"mcl", "LOCALIZATION", "pose"})->stamp(), now);

  localization.relocalize();
  const auto status = container.get<TrackData>({"mcl", "LOCALIZATION", "status"});
  ASSERT_TRUE(status);
  EXPECT_EQ(status->reason, TrackReason::kSearching);
  EXPECT_EQ(container.find({"mcl", "LOCALIZATION", "status"})->stamp(), now);
}

TEST_F(Told, APoseWhereItCantBeIsRefused) {
  Localization localization(config());
  const auto error = [&](const Pose2& pose, const PoseCovariance& covariance) {
    return messageOf<std::invalid_argument>([&] { localization.setPose(pose, covariance); });
  };
  EXPECT_EQ(error({50, 3, 0}, {}),
            "the pose set (50.00, 3.00) m is off the map, which reaches from (-2.00, -1.50) to "
            "(2.00, 1.50) m");
  EXPECT_EQ(error({1.9, 0, 0}, {}),
            "the pose set (1.90, 0.00) m is where the robot can't stand, nor within 0.10 m of it "
            "(3 sigma)");
  EXPECT_EQ(error({0, 0, 0}, {-1, 0, 0, 0, 1, 0, 0, 0, 1}),
            "covariance (x, x) is -1, expected at least 0");
  EXPECT_EQ(error({0, 0, std::nan("")}, {}), "the pose set is not a number");
  EXPECT_NEAR(localization.estimate(0)->pose.x, start.x, 0.05) << "the belief stays";
  EXPECT_NO_THROW(localization.setPose({1.9, 0, 0}, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 1}));
}

TEST_F(Told, ThatItMayBeAnywhere) {
  LocalizationConfig wrong = fromRecord();
  wrong.start = {LocalizationStart::Kind::kPose, {-0.9, 0.5, 0}, 0.01, 0.01};
  Localization localization(wrong);
  ASSERT_TRUE(localization.next());
  localization.relocalize();
  EXPECT_FALSE(localization.estimate(localization.feeder().stamp()));
  EXPECT_TRUE(localization.update()) << "the reading that is there is enough";
  while (localization.next()) {
  }
  // The room is symmetric: half a turn about its middle changes no reading.
  const Pose2 found = localization.mcl().estimate().pose;
  EXPECT_LT(std::min(distance(found, truth), distance(found, {-truth.x, -truth.y, 0})), 0.15);
}

using Kept = RoomRun;

/// A file with those arrays that a belief has, some of them exchanged.
struct MadeBelief {
  std::vector<float> x{0.9F, 0.8F}, y{0.0F, 0.1F}, theta{1.5F, 1.4F}, logWeight{0.0F, -1.0F};
  double stamp = 1e6;
  std::string world = "room-1";

  void write(const std::filesystem::path& file) const {
    TableWriter writer(file);
    writer.add<float>("x", {x.size()}, x);
    writer.add<float>("y", {y.size()}, y);
    writer.add<float>("theta", {theta.size()}, theta);
    writer.add<float>("logWeight", {logWeight.size()}, logWeight);
    writer.add<double>("stamp_us", {1}, std::span(&stamp, 1));
    writer.addText("world.txt", world);
    writer.commit();
  }
};

TEST_F(Kept, ABeliefGoesOnAfterARestart) {
  const auto file = folder / "belief";
  Pose2 last;
  {
    Localization localization(fromRecord());
    EXPECT_THROW(
        {
          Localization nowhere(LocalizationConfig{.robot = robotFile, .tables = tables});
          nowhere.saveBelief(file);
        },
        std::logic_error);
    for (int i = 0; i < 20; ++i) localization.next();
    localization.saveBelief(file);
    last = localization.mcl().estimate().pose;
    Localization restored(config());
    restored.restoreBelief(file, 0.0, 0.0);
    const SampleSet& samples = restored.mcl().samples();
    const SampleSet saved = localization.mcl().belief()->samples;
    EXPECT_EQ(samples.x, saved.x);
    EXPECT_EQ(samples.y, saved.y);
    EXPECT_EQ(samples.logWeight, saved.logWeight);
    for (std::size_t i = 0; i < samples.size(); ++i)
      EXPECT_NEAR(wrapAngle(samples.theta[i] - saved.theta[i]), 0.0, 1e-5);
  }
  // The rest of the drive with odometry that begins anew at (0, 0, 0).
  Localization restored(LocalizationConfig{.robot = robotFile, .tables = tables});
  restored.restoreBelief(file);
  ASSERT_TRUE(restored.estimate(0)) << "it waits for nothing";
  EXPECT_LT(distance(restored.estimate(0)->pose, last), 0.05);
  std::optional<Pose2> first;
  for (std::size_t i = 21; i < moments.size(); ++i) {
    auto moment = moments[i];
    const Pose2 place = [&] {
      PoseData data({"a", "groundTruth", "b"});
      data.setData(0, moment[2].words);
      return data.reading();
    }();
    if (!first) first = place;
    moment[0].words = OdometryData::encode({inverse(*first) * place, 0, 0, {}});
    restored.container().set(std::span(moment).first(2));
    restored.update();
    EXPECT_LT(distance(restored.mcl().estimate().pose, place), 0.15) << i;
  }
}

MapChanges changed() {
  using Kind = MapChange::Kind;
  MapChanges changes;
  for (std::int32_t k = 0; k < 4; ++k)
    changes.cells.push_back({Kind::kGone, k, -3, 0.1 * k + 0.03, -0.27, 4, 3, 1, 2, 19'000, true});
  changes.cells.push_back({Kind::kNew, 7, 2, 0.75, 0.25, 1, 1, 0, 1, -2});
  return changes;
}

/// Writes a belief with changes of the map.
void writeWith(const std::filesystem::path& file, const std::vector<std::int32_t>& numbers,
               const std::vector<double>& middles) {
  const MadeBelief made;
  TableWriter writer(file);
  writer.add<float>("x", {2}, made.x);
  writer.add<float>("y", {2}, made.y);
  writer.add<float>("theta", {2}, made.theta);
  writer.add<float>("logWeight", {2}, made.logWeight);
  writer.add<double>("stamp_us", {1}, std::span(&made.stamp, 1));
  writer.add<std::int32_t>("changes", {numbers.size() / 9, 9}, numbers);
  writer.add<double>("changes_m", {middles.size() / 2, 2}, middles);
  writer.addText("world.txt", made.world);
  writer.commit();
}

TEST_F(Kept, WhatHasChangedInTheWorldGoesOnAfterARestart) {
  std::vector<std::int32_t> numbers;
  std::vector<double> middles;
  for (const MapChange& one : changed().cells) {
    const auto number = [](auto value) { return static_cast<std::int32_t>(value); };
    numbers.insert(numbers.end(), {number(one.kind), one.column, one.row, number(one.passes),
                                   number(one.lately), number(one.against), number(one.days),
                                   number(one.lastDay), number(one.isSure)});
    middles.insert(middles.end(), {one.x, one.y});
  }
  writeWith(folder / "belief", numbers, middles);
  Localization localization(config());
  localization.restoreBelief(folder / "belief");
  EXPECT_EQ(localization.mcl().mapChanges().cells, changed().cells);
  const auto file = folder / "again";
  localization.saveBelief(file);
  Localization restored(config());
  restored.restoreBelief(file);
  EXPECT_EQ(restored.mcl().mapChanges().cells, changed().cells);
  const FoundChanges found = readFoundChanges(file);
  EXPECT_EQ(found.worldFingerprint, "room-1");
  ASSERT_EQ(found.changes.cells.size(), 5U);
  EXPECT_EQ(found.changes.cells[1], (ChangesData::Cell{false, true, 0.13, -0.27, 4, 1}));
}

TEST_F(Kept, WhatARecordTellsOfItLastIsFound) {
  const auto file = folder / "told.rec";
  RecordWriter writer(file, "room-1");
  writer.write(changesMessage(1'000, {}));
  writer.write(changesMessage(2'000, changed()));
  writer.write({3'000, {"a", "b", "c"}, {1}});
  writer.commit();
  EXPECT_EQ(readFoundChanges(file).changes.cells.size(), 5U);
  EXPECT_EQ(readFoundChanges(file).worldFingerprint, "room-1");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readFoundChanges(recordFile); }),
            recordFile.string() +
                ": has no reading of mcl/LOCALIZATION/map, expected a record of a localization");
  EXPECT_THROW(readFoundChanges(folder / "none"), std::runtime_error);
}

TEST_F(Kept, ChangesOfADamagedFileAreRefusedOrFitTogether) {
  RecordWriter writer(folder / "told.rec", "room-1");
  writer.write(changesMessage(2'000, changed()));
  writer.commit();
  writeWith(folder / "belief", {1, 1, 1, 1, 1, 0, 1, 0, 1}, {0.15, 0.15});
  for (const char* name : {"told.rec", "belief"}) {
    const std::string whole = readBytes(folder / name);
    for (std::size_t bit = 0; bit < 8 * whole.size(); bit += 3) {
      std::string bytes = whole;
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
      writeBytes(folder / "damaged", bytes);
      try {
        for (const auto& cell : readFoundChanges(folder / "damaged").changes.cells)
          EXPECT_TRUE(std::isfinite(cell.x) && std::isfinite(cell.y));
      } catch (const std::runtime_error&) {
        continue;  // says why
      }
    }
  }
}

TEST_F(Kept, ChangesThatCantBeAreRefused) {
  const auto refusal = [&](const std::vector<std::int32_t>& numbers,
                           const std::vector<double>& middles) {
    writeWith(folder / "belief", numbers, middles);
    Localization localization(config());
    const std::string why =
        messageOf<TableError>([&] { localization.restoreBelief(folder / "belief"); });
    EXPECT_TRUE(localization.mcl().mapChanges().cells.empty());
    return why;
  };
  const std::string name = (folder / "belief").string();
  EXPECT_EQ(refusal({2, 1, 1, 1, 1, 0, 1, 0, 0}, {0.15, 0.15}),
            name + ": changed cell 0 has the kind 2, expected 0 or 1");
  EXPECT_EQ(refusal({1, 1, 1, -1, 1, 0, 1, 0, 0}, {0.15, 0.15}),
            name + ": changed cell 0 has the count -1, expected at least 0");
  EXPECT_EQ(refusal({1, 1, 1, 1, 1, 0, 1, 0, 0}, {0.35, 0.15}),
            name + ": changed cell 0 has its middle elsewhere");
  EXPECT_NE(refusal({1, 1, 1, 1, 1, 0, 1, 0, 0}, {}).find("changes_m"), std::string::npos);
}

TEST_F(Kept, ItIsWidenedByTheStatedSigmasSinceTheRobotMayHaveBeenPushed) {
  MadeBelief many;
  many.x.assign(20000, 0.5F);
  many.y.assign(20000, -0.25F);
  many.theta.assign(20000, 3.1F);  // turns wrap around
  many.logWeight.assign(20000, 0.0F);
  const auto file = folder / "belief";
  many.write(file);
  LocalizationConfig large = config();
  large.particles = 20000;
  const auto expectSigmas = [](const Localization& localization, double position, double heading) {
    const SampleSet& samples = localization.mcl().samples();
    std::array<double, 3> sum{};
    std::array<double, 3> squares{};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::array<double, 3> off{samples.x[i] - 0.5, samples.y[i] + 0.25,
                                      wrapAngle(samples.theta[i] - 3.1)};
      for (std::size_t k = 0; k < 3; ++k) {
        sum[k] += off[k];
        squares[k] += off[k] * off[k];
      }
      ASSERT_LE(std::abs(samples.theta[i]), 3.1416F);
    }
    const auto n = static_cast<double>(samples.size());
    ASSERT_EQ(samples.size(), 20000U);
    for (std::size_t k = 0; k < 3; ++k) {  // four standard errors of mean and sigma
      const double sigma = k == 2 ? heading : position;
      EXPECT_NEAR(sum[k] / n, 0.0, 4 * sigma / std::sqrt(n) + 1e-6) << k;
      EXPECT_NEAR(std::sqrt(squares[k] / n), sigma, 4 * sigma / std::sqrt(2 * n) + 1e-6) << k;
    }
  };
  Localization localization(large);
  localization.restoreBelief(file);
  expectSigmas(localization, 0.1, 5 * kPi / 180);
  localization.restoreBelief(file, 0.4, 0.02);
  expectSigmas(localization, 0.4, 0.02);
  localization.restoreBelief(file, 0.0, 0.0);
  expectSigmas(localization, 0.0, 0.0);
  const SampleSet before = localization.mcl().samples();
  for (const auto& [position, heading] :
       {std::pair(-0.1, 0.1), {0.1, -0.1}, {std::nan(""), 0.1}, {0.1, INFINITY}}) {
    EXPECT_THROW(localization.restoreBelief(file, position, heading), std::invalid_argument);
    EXPECT_EQ(localization.mcl().samples().x, before.x) << "the belief stays";
  }
}

// Saved when it was sure, and pushed by 0.2 m and 8 degrees while nobody looked.
TEST_F(Kept, ARobotThatWasPushedWhileItWasOffIsRightAfterTheFirstReading) {
  for (const double turn : {8.0, -8.0}) {
    MadeBelief sure;
    const Pose2 pushed = start * Pose2{0.15, turn > 0 ? 0.13 : -0.13, turn * kPi / 180};
    sure.x.assign(500, static_cast<float>(pushed.x));
    sure.y.assign(500, static_cast<float>(pushed.y));
    sure.theta.assign(500, static_cast<float>(pushed.theta));
    sure.logWeight.assign(500, 0.0F);
    const auto file = folder / "belief";
    sure.write(file);
    Localization localization(LocalizationConfig{.robot = robotFile, .tables = tables});
    localization.restoreBelief(file);
    std::size_t within = 0;
    for (const auto& moment : moments) {
      localization.container().set(std::span(moment).first(2));
      const auto estimate = localization.update();
      if (!estimate) continue;
      PoseData there({"a", "groundTruth", "b"});
      there.setData(0, moment[2].words);
      if (within++ == 0) continue;
      EXPECT_LT(distance(estimate->pose, there.reading()), 0.08) << turn << " " << moment[0].stamp;
    }
    EXPECT_GT(within, 10U);
  }
}

TEST_F(Kept, AReadableFileThatCantBeABeliefIsRefusedWithTheReason) {
  const auto file = folder / "belief";
  Localization localization(config());
  const std::vector<float> before = localization.mcl().samples().x;
  const auto refused = [&](auto change, const std::string& reason) {
    MadeBelief made;
    change(made);
    made.write(file);
    EXPECT_EQ(messageOf<TableError>([&] { localization.restoreBelief(file); }),
              file.string() + ": " + reason);
    EXPECT_EQ(localization.mcl().samples().x, before) << "the belief stays";
  };
  refused([](MadeBelief& b) { b.x[1] = std::nanf(""); },
          "sample 1 of the belief is at (nan, 0.1, 1.4), expected numbers within 1e+06 m");
  refused([](MadeBelief& b) { b.logWeight[0] = std::nanf(""); },
          "sample 0 of the belief has the logarithmic weight nan, expected a number");
  refused([](MadeBelief& b) { b.y.push_back(0); }, "table y has <f4 3, expected <f4 2");
  refused([](MadeBelief& b) { b.stamp = HUGE_VAL; }, "its stamp_us is inf, expected microseconds");
  refused([](MadeBelief& b) { b.world = "room-2"; },
          "is a belief about the world 'room-2', but the tables were learned in 'room-1' ('room')");
  refused([](MadeBelief& b) { b.x = {30, 40}; },
          "none of its samples is where the robot can stand");
  MadeBelief{}.write(file);
  localization.restoreBelief(file, 0.0, 0.0);
  EXPECT_EQ(localization.mcl().samples().x, MadeBelief{}.x);
}

TEST_F(Kept, FilesThatAreNoBeliefOrTornAreRefused) {
  const auto file = folder / "belief";
  Localization localization(config());
  const auto error = [&](const std::filesystem::path& f) {
    return messageOf<TableError>([&] { localization.restoreBelief(f); });
  };
  EXPECT_EQ(error(folder / "none"),
            (folder / "none").string() + ": can't be read: No such file or directory");
  EXPECT_NE(error(tables).find("has no table logWeight"), std::string::npos) << error(tables);
  writeBytes(file, "not a belief");
  EXPECT_NE(error(file).find("is torn or no table file"), std::string::npos) << error(file);
  localization.saveBelief(file);
  std::ifstream in(file, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  // Cut anywhere.
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 97) {
    writeBytes(file, whole.substr(0, at));
    EXPECT_THROW(localization.restoreBelief(file), TableError) << at;
  }
  writeBytes(file, whole);
  localization.restoreBelief(file);
  const SampleSet good = localization.mcl().samples();
  // A bit turned anywhere is noticed, or it is one that nobody reads, of what aligns the arrays.
  std::size_t refused = 0;
  std::size_t tried = 0;
  for (std::size_t at = 0; at < whole.size(); at += 61, ++tried) {
    std::string turned = whole;
    turned[at] = static_cast<char>(turned[at] ^ (1 << at % 8));
    writeBytes(file, turned);
    try {
      localization.restoreBelief(file);
    } catch (const TableError&) {
      ++refused;
    }
    const SampleSet& now = localization.mcl().samples();
    ASSERT_TRUE(now.x == good.x && now.y == good.y && now.theta == good.theta &&
                now.logWeight == good.logWeight)
        << at;
  }
  EXPECT_GT(refused, tried * 9 / 10);
}

using Published = RoomRun;

TEST_F(Published, IsEachEstimateAsAFeature) {
  LocalizationConfig published = fromRecord();
  published.publish = true;
  Localization localization(published);
  Localization silent(fromRecord());
  const SensorQuery query{"mcl", "LOCALIZATION", "pose"};
  EXPECT_FALSE(localization.container().get<PoseFixData>(query));
  std::size_t estimates = 0;
  while (const auto estimate = localization.next()) {
    const auto fixes = localization.container().get<PoseFixData>(query);
    ASSERT_TRUE(fixes);
    ASSERT_EQ(fixes->size(), 1U);
    const PoseFixData::Fix& fix = fixes->front();
    EXPECT_LT(distance(fix.pose, estimate->pose), 0.001);  // words are mm
    EXPECT_NEAR(wrapAngle(fix.pose.theta - estimate->pose.theta), 0.0, 1e-4);
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(fix.covariance[i], estimate->covariance[i],
                  2e-4 * estimate->covariance[i % 4 == 0 ? i : 0] + 1e-6);
    EXPECT_EQ(localization.container().find(query)->stamp(), estimate->stamp);
    // It is no evidence: who publishes gets the same as who does not.
    const auto other = silent.next();
    ASSERT_TRUE(other);
    EXPECT_EQ(other->pose.x, estimate->pose.x);
    EXPECT_EQ(other->covariance, estimate->covariance);
    ++estimates;
  }
  EXPECT_GT(estimates, 10U);
  EXPECT_FALSE(silent.container().find(query));
}

// A clock that was set back is noticed, though what was published is as late as the belief.
TEST_F(Published, DoesNotHideAClockThatWasSetBack) {
  std::array<std::size_t, 2> weighed{};
  for (const bool publish : {false, true}) {
    LocalizationConfig published = config();
    published.publish = publish;
    Localization localization(published);
    for (auto moment : moments) {
      for (Message& message : moment) message.stamp += 100'000'000;
      localization.container().set(std::span(moment).first(2));
      localization.update();
    }
    const Timestamp late = localization.mcl().estimate().stamp;
    for (auto moment = moments.rbegin(); moment != moments.rend(); ++moment) {
      auto back = *moment;
      for (Message& message : back) message.stamp = moments.back()[0].stamp - message.stamp;
      localization.container().set(std::span(back).first(2));
      if (localization.update()) ++weighed[publish ? 1 : 0];
    }
    EXPECT_LT(localization.mcl().estimate().stamp, late);
    EXPECT_LT(distance(localization.mcl().estimate().pose, start), 0.15) << publish;
  }
  EXPECT_GT(weighed[0], 10U);
  EXPECT_EQ(weighed[1], weighed[0]) << "it is noticed as soon";
}

}  // namespace
}  // namespace ortung::test
