// Every bit of a table file with a feature of each format, flipped: as an accident (checksums catch
// it) and with the checksums mended, as a hostile writer would. What is taken then weighs poses.
#include <cmath>
#include <numbers>

#include "FlippedBits.hpp"
#include "Golden.hpp"
#include "MendedFiles.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung {
namespace {

using test::Fate;
using test::flipBits;
using test::goldenFile;
using test::readBytes;
using test::TemporaryFolder;
using test::writeBytes;
using Words = std::vector<std::uint32_t>;

constexpr double kPi = std::numbers::pi;

/// The features of tests/data/tables1.ortung, each with a reading.
void fill(SensorContainer& container) {
  const auto add = [&](std::unique_ptr<SensorData> data, const Words& words) {
    container.add(std::move(data)).setData(1, words);
  };
  add(std::make_unique<ScalarData>(SensorId{"cam", "camera", "post1Distance"}, Pose2{},
                                   ScalarData::Config{}),
      {1500});
  add(std::make_unique<BearingData>(SensorId{"cam", "camera", "post1Bearing"}, Pose2{},
                                    BearingData::Config{}),
      {19000});
  add(std::make_unique<LandmarksData>(
          SensorId{"cam", "camera", "posts"}, Pose2{},
          LandmarksData::Config{.identities = {7, 4000000000}, .range = {}}),
      {7, 2000, 9000});
  add(std::make_unique<PointsData>(SensorId{"cam", "camera", "lines"}, Pose2{},
                                   PointsData::Config{.cell = 0.5}),
      {750, 18000});
  add(std::make_unique<ConeData>(SensorId{"Polaroid", "sonar", "front"}, Pose2{},
                                 ConeData::Config{}),
      {800});
  ScanData::Config scan{.beams = 4, .firstAngle = -kPi / 2, .angleStep = kPi / 2};
  add(std::make_unique<ScanData>(SensorId{"LMS200", "LRF", "rays"}, Pose2{}, scan),
      {1000, 2000, 0, 8001});
  scan.perception = ScanData::Perception::kEndPoints;
  scan.endPointCell = 0.5;
  add(std::make_unique<ScanData>(SensorId{"LMS200", "LRF", "points"}, Pose2{}, scan),
      {0, 750, 0, 8001});
}

/// Weighs poses inside and outside of the field by every feature, one by one and as a set.
void weigh(const SensorContainer& container) {
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> theta;
  for (int i = 0; i < 24; ++i) {
    x.push_back(-2.0F + 0.7F * static_cast<float>(i % 6));
    y.push_back(-1.5F + static_cast<float>(i / 6));
    theta.push_back(0.9F * static_cast<float>(i));
  }
  std::vector<float> log(x.size(), 0.0F);
  container.getProbability(SampleView{x, y, theta}, log);
  for (const float l : log) ASSERT_LE(l, 0.0F);  // not NaN either
  for (std::size_t i = 0; i < x.size(); i += 5) {
    const double p = container.getProbability(Pose2{x[i], y[i], theta[i]});
    ASSERT_TRUE(p == kNoExpectation || (p >= 0.0 && p <= 1.0)) << p;
    for (const auto& data : container.all()) data->expectation({x[i], y[i], theta[i]});
  }
}

void useTables(const std::filesystem::path& file) {
  SensorContainer container;
  fill(container);
  loadTables(std::make_shared<TableFile>(file), container);
  weigh(container);
}

TEST(FlippedBits, OfTables) {
  const TemporaryFolder folder;
  const std::string whole = readBytes(goldenFile("tables1.ortung"));
  const Fate fate = flipBits<TableError>(
      whole,
      [&](const std::string& bytes) {
        writeBytes(folder / "t.ortung", bytes);
        useTables(folder / "t.ortung");
      },
      test::everyOrAll(11));
  EXPECT_GT(fate.taken, 0);  // dates and padding
  EXPECT_GT(fate.refused, fate.taken);
}

TEST(FlippedBits, OfTablesWithMendedChecksums) {
  const TemporaryFolder folder;
  const std::string whole = readBytes(goldenFile("tables1.ortung"));
  std::string mended = whole;
  test::mendZip(mended);
  ASSERT_TRUE(mended == whole) << "mending must change nothing where nothing is wrong";
  const Fate fate = flipBits<TableError>(
      whole,
      [&](std::string bytes) {
        test::mendZip(bytes);
        writeBytes(folder / "t.ortung", bytes);
        useTables(folder / "t.ortung");
      },
      test::everyOrAll(7));
  EXPECT_GT(fate.taken, 1000) << "levels, names";
  EXPECT_GT(fate.refused, 1000) << "keys, shapes, row numbers";
}

// A header that promises more than the file has is refused before memory is taken for it
// (FlippedBits.hpp limits it); so is a region of more cells than the learner makes.
TEST(HostileTables, RegionsOfTooManyCellsAreRefused) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> cells((std::size_t{1} << 26) + 1, 1);
  TableWriter writer(folder / "t.ortung");
  writer.add<std::uint8_t>("open", {1, cells.size()}, cells);
  writer.addText("meta.json",
                 R"({"format": "ortung tables", "version": 1, "world": "w", "robot": "r",
                     "world_fingerprint": "", "heading_step_rad": 0.1, "origin_x_m": 0,
                     "origin_y_m": 0, "cell_m": 0.1, "features": []})");
  writer.commit();
  EXPECT_NE(test::messageOf<TableError>([&] {
              readTableInfo(TableFile(folder / "t.ortung"));
            }).find("impossible shape"),
            std::string::npos);
}

}  // namespace
}  // namespace ortung
