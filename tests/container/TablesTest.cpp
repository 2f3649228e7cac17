#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "FakeRoom.hpp"
#include "Files.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung {
namespace {

using test::kPi;
using test::messageOf;
using test::Room;
using test::TemporaryFolder;
using Words = std::vector<std::uint32_t>;

const Room kRoom;
const std::vector<test::Point> kPosts = {{1, 1.1, -0.7}, {2, -2.0, 1.5}};

/// A robot with one feature of each format; @p beams and @p mount can be made to differ.
struct Robot {
  explicit Robot(int beams = 90, const Pose2& mount = {}) {
    const ScanData::Config scan{.beams = beams, .firstAngle = -kPi / 2, .angleStep = kPi / 90};
    ScanData::Config points = scan;
    points.perception = ScanData::Perception::kEndPoints;
    points.endPointCell = 0.1;
    add(std::make_unique<ScalarData>(SensorId{"cam", "camera", "post1Distance"}, mount,
                                     ScalarData::Config{}),
        [](const Pose2& s) { return ScalarData::encode(std::hypot(1.1 - s.x, -0.7 - s.y)); });
    add(std::make_unique<BearingData>(SensorId{"cam", "camera", "post1Bearing"}, mount,
                                      BearingData::Config{}),
        [](const Pose2& s) { return BearingData::encode(test::bearingTo(s, 1.1, -0.7)); });
    add(std::make_unique<LandmarksData>(SensorId{"cam", "camera", "posts"}, mount,
                                        LandmarksData::Config{.identities = {1, 2}, .range = {}}),
        [](const Pose2& s) { return test::landmarkWords(kPosts, s, 20.0); });
    add(std::make_unique<ConeData>(SensorId{"Polaroid", "sonar", "front"}, mount,
                                   ConeData::Config{}),
        [](const Pose2& s) {
          return Words{ConeData::encode(kRoom.range(s.x, s.y, s.theta), 3.0)};
        });
    add(std::make_unique<ScanData>(SensorId{"LMS200", "LRF", "rays"}, mount, scan),
        [scan](const Pose2& s) { return test::scanWords(kRoom, s, scan); });
    add(std::make_unique<ScanData>(SensorId{"LMS200", "LRF", "points"}, mount, points),
        [points](const Pose2& s) { return test::scanWords(kRoom, s, points); });
    container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
  }
  template <class Data>
  void add(std::unique_ptr<Data> data, std::function<Words(const Pose2&)> words) {
    container.add(std::move(data));
    readings.push_back(std::move(words));
  }
  void learn(const FieldRegion& region) {
    for (std::size_t i = 0; i < readings.size(); ++i)
      test::learnEverywhere(*container.all()[i], region, kPi / 90, readings[i]);
  }
  void read(const Pose2& sensor) {
    for (std::size_t i = 0; i < readings.size(); ++i)
      container.all()[i]->setData(1, readings[i](sensor));
  }
  SensorContainer container;
  std::vector<std::function<Words(const Pose2&)>> readings;
};

TableInfo infoOf(const FieldRegion& region) {
  return {"room", "0123456789abcdef", "robot", kPi / 90, region, {}};
}

class Tables : public ::testing::Test {
 protected:
  void SetUp() override {
    Robot robot;
    robot.learn(region_);
    writeTables(file_, robot.container, infoOf(region_));
  }
  std::shared_ptr<const TableFile> open() const { return std::make_shared<TableFile>(file_); }
  std::string complaintOf(SensorContainer& container) const {
    return messageOf<TableError>([&] { loadTables(open(), container); });
  }
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "room.npz";
  const FieldRegion region_ = kRoom.region(0.2, 0.2);
};

TEST_F(Tables, GiveTheSameProbabilitiesAsTheLearner) {
  Robot learner;
  learner.learn(region_);
  Robot user;
  loadTables(open(), user.container);
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Pose2 truth{random.uniform(-3.5, 3.5), random.uniform(-2, 2), random.uniform(-3, 3)};
    learner.read(truth);
    user.read(truth);
    const Pose2 pose =
        truth * Pose2{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    for (std::size_t f = 0; f < learner.readings.size(); ++f) {
      ASSERT_EQ(learner.container.all()[f]->getProbability(pose),
                user.container.all()[f]->getProbability(pose))
          << f;
      ASSERT_EQ(test::batchOfOne(*learner.container.all()[f], pose),
                test::batchOfOne(*user.container.all()[f], pose))
          << f;
    }
  }
}

TEST_F(Tables, TellWhatTheyAre) {
  const TableInfo info = readTableInfo(*open());
  EXPECT_EQ(info.world, "room");
  EXPECT_EQ(info.worldFingerprint, "0123456789abcdef");
  EXPECT_EQ(info.robot, "robot");
  EXPECT_DOUBLE_EQ(info.headingStep, kPi / 90);
  EXPECT_EQ(info.region.grid, region_.grid);
  EXPECT_EQ(info.region.open, region_.open);
  EXPECT_EQ(info.region.standable, region_.standable);
  ASSERT_EQ(info.features.size(), 6u) << "odometry learns nothing";
  EXPECT_EQ(info.features[0].id, "cam/camera/post1Distance");
}

TEST_F(Tables, KeepTheFileAliveForTheirUsers) {
  Robot user;
  loadTables(open(), user.container);  // the only other owner is gone now
  user.read({0.5, 0.5, 0.0});
  EXPECT_GT(user.container.getProbability(Pose2{0.5, 0.5, 0.0}), 0.0);
}

TEST_F(Tables, OfAnotherRobotAreRefusedByName) {
  Robot other;
  other.container.add(std::make_unique<ScalarData>(SensorId{"cam", "camera", "post9Distance"},
                                                   Pose2{}, ScalarData::Config{}));
  EXPECT_EQ(complaintOf(other.container),
            file_.string() +
                ": has no tables of cam/camera/post9Distance, so it was learned for another robot "
                "('robot') or before this sensor was there; learn again");
}

TEST_F(Tables, OfAnotherSensorAreRefusedWithBothSettings) {
  Robot other(91);
  const std::string told = complaintOf(other.container);
  EXPECT_TRUE(told.starts_with(
      file_.string() +
      ": the tables of LMS200/LRF/rays were learned for another sensor: found 'scan beams=90 "))
      << told;
  EXPECT_NE(told.find("', the robot file says 'scan beams=91 "), std::string::npos) << told;
  Robot moved(90, {0.1, 0, 0});
  EXPECT_NE(complaintOf(moved.container)
                .find("mount=0,0,0', the robot file says 'distance max_range_m=20 fov_rad=0 "
                      "mount=0.1,0,0'"),
            std::string::npos)
      << complaintOf(moved.container);
}

TEST_F(Tables, NoiseAndThinningAreNoOtherSensor) {
  SensorContainer container;
  container.add(std::make_unique<ScalarData>(SensorId{"cam", "camera", "post1Distance"}, Pose2{},
                                             ScalarData::Config{.model = {.sigma = 0.7}}));
  EXPECT_NO_THROW(loadTables(open(), container));
}

TEST_F(Tables, NamesThatLookAlikeDoNotCollide) {
  SensorContainer container;
  const std::string longest(64, 'x');
  const std::vector<SensorId> ids = {
      {"a.b", "c", "d"}, {"a", "b.c", "d"}, {longest, longest, longest}};
  double range = 1.0;
  for (const SensorId& id : ids) {
    SensorData& data =
        container.add(std::make_unique<ScalarData>(id, Pose2{}, ScalarData::Config{}));
    test::learnEverywhere(data, region_, 1.0,
                          [&](const Pose2&) { return ScalarData::encode(range); });
    range += 1.0;
  }
  writeTables(folder_ / "names.npz", container, infoOf(region_));
  SensorContainer user;
  for (const SensorId& id : ids)
    user.add(std::make_unique<ScalarData>(id, Pose2{}, ScalarData::Config{}));
  loadTables(std::make_shared<TableFile>(folder_ / "names.npz"), user);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_NEAR(user.all()[i]->expectation(Pose2{})[0], 1.0 + static_cast<double>(i), 1e-6);
  }
}

FieldModel someField() {
  FieldModel field;
  FieldLine arc;
  arc.shape = FieldLine::Shape::kArc;
  arc.x = 1.0;
  arc.radiusX = arc.radiusY = 0.5;
  arc.to = 2.0;
  arc.width = 0.1;
  arc.colour = "white";
  FieldLine straight;
  straight.x1 = 3.0;
  straight.width = 0.12;
  field.lines = {arc, straight};
  field.walls = {{0.1, 0.2, 0.3, 0.4, 0.0, 1.0, false}, {1, 2, 3, 4, 0, 0.5, true}};
  field.goals = {{"yellow goal", "yellow", {4.5, 0.0, 3.0}, 0.2, 1.0, 0.9}};
  field.landmarks = {{7, "post", 1.0, -2.0, 0.5}};
  return field;
}

TEST_F(Tables, KeepWhatIsKnownOfTheField) {
  TableInfo info = infoOf(region_);
  info.field = someField();
  Robot robot;
  robot.learn(region_);
  writeTables(folder_ / "field.npz", robot.container, info);
  const TableInfo read = readTableInfo(TableFile(folder_ / "field.npz"));
  ASSERT_EQ(read.field.lines.size(), 2u);
  EXPECT_EQ(read.field.lines[0].shape, FieldLine::Shape::kArc);
  EXPECT_EQ(read.field.lines[0].to, 2.0);
  EXPECT_EQ(read.field.lines[0].colour, "white");
  EXPECT_EQ(read.field.lines[1].x1, 3.0);
  EXPECT_EQ(read.field.lines[1].width, 0.12);
  ASSERT_EQ(read.field.walls.size(), 2u);
  EXPECT_EQ(read.field.walls[0].y1, 0.4);
  EXPECT_TRUE(read.field.walls[1].ofGoal);
  ASSERT_EQ(read.field.goals.size(), 1u);
  EXPECT_EQ(read.field.goals[0].name, "yellow goal");
  EXPECT_EQ(read.field.goals[0].pose.theta, 3.0);
  ASSERT_EQ(read.field.landmarks.size(), 1u);
  EXPECT_EQ(read.field.landmarks[0].identity, 7u);
  EXPECT_EQ(read.field.landmarks[0].y, -2.0);
  EXPECT_TRUE(readTableInfo(TableFile(file_)).field.isEmpty());
}

TEST_F(Tables, KeepTheFloorsOfABuilding) {
  TableInfo info = infoOf(region_);
  Building& building = info.region.building;
  building.floors = {{"ground", 0.0, -5.25, 15.0}, {"first", 30.0, 15.0, 45.0}};
  building.lifts = {{"A", 1.25, {{0, {3.5, 1, 0.5}}, {1, {33, 1, -0.5}}}}};
  Robot robot;
  robot.learn(region_);
  writeTables(folder_ / "building.npz", robot.container, info);
  const Building read = readTableInfo(TableFile(folder_ / "building.npz")).region.building;
  ASSERT_EQ(read.floors.size(), 2u);
  EXPECT_EQ(read.floors[0].name, "ground");
  EXPECT_EQ(read.floors[0].xLow, -5.25);
  EXPECT_EQ(read.floors[1].shift, 30.0);
  EXPECT_EQ(read.floors[1].xHigh, 45.0);
  ASSERT_EQ(read.lifts.size(), 1u);
  EXPECT_EQ(read.lifts[0].name, "A");
  EXPECT_EQ(read.lifts[0].radius, 1.25);
  ASSERT_EQ(read.lifts[0].stops.size(), 2u);
  EXPECT_EQ(read.lifts[0].stops[1].floor, 1u);
  EXPECT_EQ(read.lifts[0].stops[0].pose.theta, 0.5);
  EXPECT_EQ(read.lifts[0].stops[1].pose.x, 33.0);
  EXPECT_EQ(read.lifts[0].stops[1].pose.y, 1.0);
  EXPECT_TRUE(readTableInfo(TableFile(file_)).region.building.isEmpty());
}

/// The example's arrays with another meta.json (and, if given, another array in place of its own).
std::string complaintWith(const TemporaryFolder& folder, const TableFile& from,
                          const std::string& meta, const TableArray* instead = nullptr) {
  const auto file = folder / "forged.npz";
  TableWriter writer(file);
  for (const TableArray& array : from.arrays())
    writer.addBytes(instead && instead->name == array.name ? *instead : array);
  writer.addText("meta.json", meta);
  writer.commit();
  Robot robot;
  const std::string told = messageOf<TableError>(
      [&] { loadTables(std::make_shared<TableFile>(file), robot.container); });
  return told.starts_with(file.string()) ? told.substr(file.string().size()) : told;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(Tables, ForgedMetaIsRefusedWithAReason) {
  const auto file = open();
  const std::string meta = file->text("meta.json");
  EXPECT_EQ(complaintWith(folder_, *file, meta), "(nothing was thrown)");
  EXPECT_EQ(complaintWith(folder_, *file, "{"), ": meta.json is no JSON object");
  EXPECT_EQ(complaintWith(folder_, *file, "[1]"), ": meta.json is no JSON object");
  EXPECT_EQ(complaintWith(folder_, *file, replaced(meta, "\"version\": 1", "\"version\": 9")),
            ": has format version 9, this program reads 1; learn the tables again");
  EXPECT_EQ(complaintWith(folder_, *file, replaced(meta, "\"robot\"", "\"rabot\"")),
            ": meta.json: 'robot' is missing or of the wrong kind");
  EXPECT_EQ(complaintWith(folder_, *file, replaced(meta, "\"cell_m\": 0.2", "\"cell_m\": \"x\"")),
            ": meta.json: 'cell_m' is missing or of the wrong kind");
  EXPECT_EQ(complaintWith(folder_, *file, replaced(meta, "\"cell_m\": 0.2", "\"cell_m\": -1")),
            ": field region: the grid must have cells of positive, finite size");
  EXPECT_EQ(complaintWith(folder_, *file, replaced(meta, "\"cell_m\": 0.2", "\"cell_m\": null")),
            ": meta.json: 'cell_m' is missing or of the wrong kind");
  EXPECT_NE(complaintWith(folder_, *file, replaced(meta, "\"prefix\": \"", "\"prefix\": \"no"))
                .find("has no table no"),
            std::string::npos);
}

TEST_F(Tables, AForgedFieldIsRefusedWithAReason) {
  const auto file = open();
  const std::string meta = file->text("meta.json");
  const auto with = [&](const std::string& field) {
    return complaintWith(folder_, *file,
                         replaced(meta, "\"features\"", "\"field\": " + field + ", \"features\""));
  };
  const std::string rest = "\"lines\": [], \"goals\": [], \"landmarks\": []";
  EXPECT_EQ(with("{\"walls\": [], " + rest + "}"), "(nothing was thrown)");
  for (const std::string& field :
       {std::string("3"), std::string("{}"), "{\"walls\": 1, " + rest + "}",
        "{\"walls\": [[1, 2]], " + rest + "}",
        "{\"walls\": [[1, 2, 3, 4, 5, 6, \"yes\"]], " + rest + "}",
        "{\"walls\": [[1e300, 2, 3, 4, 5, 6, true]], " + rest + "}",
        "{\"walls\": [[null, 2, 3, 4, 5, 6, true]], " + rest + "}"}) {
    const std::string told = with(field);
    EXPECT_TRUE(told.starts_with(": meta.json: field: ")) << field << ": " << told;
  }
}

TEST_F(Tables, AForgedBuildingIsRefusedWithAReason) {
  const auto file = open();
  const std::string meta = file->text("meta.json");
  const auto with = [&](const std::string& building) {
    return complaintWith(
        folder_, *file,
        replaced(meta, "\"features\"", "\"building\": " + building + ", \"features\""));
  };
  const std::string floors =
      "\"floors\": [{\"name\": \"g\", \"shift_m\": 0, \"x_m\": [0, 9]}, "
      "{\"name\": \"one\", \"shift_m\": 9, \"x_m\": [9, 18]}]";
  const auto liftAt = [&](const std::string& stops) {
    return "{" + floors + ", \"lifts\": [{\"name\": \"A\", \"radius_m\": 1, \"stops\": [" + stops +
           "]}]}";
  };
  const std::string only = "{\"floor\": 0, \"pose\": [1, 0, 0]}";
  const std::string first = only + ", ";
  EXPECT_EQ(with("{" + floors + ", \"lifts\": []}"), "(nothing was thrown)");
  EXPECT_EQ(with(liftAt(first + "{\"floor\": 1, \"pose\": [10, 0, 0]}")), "(nothing was thrown)");
  for (const std::string& building :
       {std::string("3"), std::string("{}"), "{" + floors + "}",
        std::string("{\"floors\": [{\"name\": 1}], \"lifts\": []}"), liftAt(only),
        liftAt(first + "{\"floor\": -1, \"pose\": [10, 0, 0]}"),
        liftAt(first + "{\"floor\": 1, \"pose\": [10, 0]}"),
        liftAt(first + "{\"floor\": 1, \"pose\": [null, 0, 0]}"),
        liftAt(first + "{\"floor\": 1, \"pose\": [2, 0, 0]}")}) {
    const std::string told = with(building);
    EXPECT_TRUE(told.starts_with(": meta.json: building: ")) << building << ": " << told;
  }
}

TEST_F(Tables, ForgedArraysAreRefusedWithAReason) {
  const auto file = open();
  const std::string meta = file->text("meta.json");
  const auto find = [&](const std::string& ending) {
    for (const TableArray& a : file->arrays()) {
      if (a.name.ends_with(ending)) return a;
    }
    return TableArray{};
  };
  // A row number beyond the table.
  TableArray rows = find("rays.row_of_cell");
  ASSERT_FALSE(rows.name.empty());
  std::vector<std::byte> bytes(rows.bytes.begin(), rows.bytes.end());
  bytes[2] = std::byte{0x7F};
  rows.bytes = bytes;
  EXPECT_EQ(complaintWith(folder_, *file, meta, &rows),
            ": table LMS200.LRF.rays.levels does not fit its row numbers");
  // Another number of directions, and an impossible one.
  TableArray directions = find("rays.directions");
  for (const std::int32_t wrong : {181, 0, -5, 1 << 30}) {
    std::vector<std::byte> number(4);
    std::memcpy(number.data(), &wrong, 4);
    directions.bytes = number;
    EXPECT_NE(complaintWith(folder_, *file, meta, &directions).find("table LMS200.LRF.rays."),
              std::string::npos)
        << wrong;
  }
  // A mask of another shape.
  TableArray open = find("standable");
  std::swap(open.shape[0], open.shape[1]);
  EXPECT_NE(complaintWith(folder_, *file, meta, &open).find("table standable has |u1"),
            std::string::npos);
  // An end-point field of cells without size.
  TableArray place = find("end_point_grid");
  const std::vector<double> numbers = {0.0, 0.0, 0.0};
  place.bytes = std::as_bytes(std::span(numbers));
  EXPECT_NE(complaintWith(folder_, *file, meta, &place).find("has impossible values"),
            std::string::npos);
}

}  // namespace
}  // namespace ortung
