// From a drive in a world that is no longer what was learned to a map that fits again.
#include <algorithm>
#include <array>
#include <cmath>

#include "Workspace.hpp"
#include "ortung/formats/ChangesData.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung::test {
namespace {

class MendMap : public Workspace {
 protected:
  Outcome mendBy(const std::string& changes, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command = {"mend-map",    path("hall.toml"), "--changes",
                                        path(changes), "--out",           path("mended.toml")};
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  }
  /// A record with what a localization has told of the map last.
  void tell(const std::string& name, const std::vector<ChangesData::Cell>& cells,
            const std::string& world = "") const {
    RecordWriter writer(path(name), world);
    writer.write(ChangesData::message(1'000'000, {0.1, cells}));
    writer.commit();
  }
  /// The value of the mended map at a place.
  int valueAt(double x, double y) const {
    const std::string yaml = read("mended.yaml");
    double left = 0.0;
    double bottom = 0.0;
    double cell = 0.0;
    EXPECT_EQ(std::sscanf(yaml.c_str() + yaml.find("resolution"),
                          "resolution: %lf\norigin: [%lf, %lf", &cell, &left, &bottom),
              3);
    const std::string pgm = read("mended.pgm");
    int columns = 0;
    int rows = 0;
    EXPECT_EQ(std::sscanf(pgm.c_str(), "P5\n%d %d\n255\n", &columns, &rows), 2);
    const int column = static_cast<int>(std::floor((x - left) / cell));
    const int row = static_cast<int>(std::floor((y - bottom) / cell));
    const auto at = static_cast<std::size_t>((rows - 1 - row) * columns + column);
    return static_cast<unsigned char>(pgm.at(pgm.find("255\n") + 4 + at));
  }
};

constexpr int kFree = 254;
constexpr int kOccupied = 0;

// The box on the lower right stands 2.3 m farther to the left than was learned.
TEST_F(MendMap, ADriveShowsWhatWasMovedAndTheProposalFits) {
  learnTables();
  write("moved.toml", read("hall.toml"));
  replace("moved.toml", "center_m = [2.4, -1.0]", "center_m = [0.1, -1.0]");
  const std::string source = "sim:" + path("moved.toml") + "?duration=240&seed=2";
  const auto localize = [&](const std::string& tables, const std::vector<std::string>& more) {
    std::vector<std::string> command = {
        "localize", "--robot", path("robot.toml"), "--tables", path(tables), "--source", source};
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  };
  const Outcome drive =
      localize("hall.ortung", {"--start", "truth", "--any-world", "--belief", path("belief")});
  ASSERT_EQ(drive.exitCode, 0) << drive.err;
  const Outcome mended = mendBy("belief", {"--picture", path("mended.png")});
  ASSERT_EQ(mended.exitCode, 0) << mended.err;
  EXPECT_TRUE(mended.out.starts_with(path("mended.toml") + ": ")) << mended.out;
  EXPECT_TRUE(read("mended.png").starts_with("\x89PNG"));
  EXPECT_EQ(valueAt(2.58, -0.41), kFree) << "the right end of its upper side";
  // What lies farther behind its sides is free only if beams were expected at its back, too.
  EXPECT_EQ(valueAt(2.3, -1.0), kFree) << "its inside";
  EXPECT_EQ(valueAt(0.0, 0.5), kFree);
  int side = 0;
  for (double y = -1.5; y < -0.5; y += 0.05)
    side += std::min({valueAt(-0.14, y), valueAt(-0.09, y), valueAt(-0.04, y)}) == kOccupied;
  EXPECT_GE(side, 14) << "the left side of the box where it stands now, of 20 places";
  EXPECT_NE(valueAt(-2.65, 1.4), kFree) << "the other box stays";

  ASSERT_EQ(ortung({"learn", "--world", path("mended.toml"), "--robot", path("robot.toml"), "--out",
                    path("mended.ortung")})
                .exitCode,
            0);
  const Outcome again =
      localize("mended.ortung", {"--start", "truth", "--any-world", "--belief", path("after")});
  ASSERT_EQ(again.exitCode, 0) << again.err;
  const Outcome nothing = ortung(
      {"mend-map", path("mended.toml"), "--changes", path("after"), "--out", path("again.toml")});
  expectRefused(nothing, 1, "ortung mend-map: " + path("after"), {"nothing is sure"});
}

TEST_F(MendMap, LinesLandmarksAndWhatIsMovableStayAsTheyWere) {
  write("hall.toml", read("hall.toml") + R"([[rectangle]]
kind = "line"
center_m = [0, 0]
size_m = [1, 0.05]
[[ellipse]]
kind = "ball"
center_m = [0.5, 0.5]
size_m = [0.2, 0.2]
z_m = [0, 0.2]
[[ellipse]]
kind = "post"
identity = 7
center_m = [0, 1.5]
size_m = [0.1, 0.1]
[[landmark]]
kind = "lamp"
identity = 3
position_m = [1, 1, 2]
)");
  tell("told.rec", {{false, true, 2.2, -1.0, 2, 0}});
  ASSERT_EQ(mendBy("told.rec").exitCode, 0);
  const std::string check = ortung({"check", path("mended.toml")}).out;
  EXPECT_NE(check.find("landmarks: 1 lamp, 1 post"), std::string::npos) << check;
  const std::string text = read("mended.toml");
  for (const char* kept :
       {"'line'", "'ball'", "kind = \"lamp\"\nidentity = 3\nposition_m = [1, 1, 2]",
        "kind = \"post\"\nidentity = 7\nposition_m = [0, 1.5, 0.5]", "map = \"mended.yaml\"",
        "name = 'hall'"})
    EXPECT_NE(text.find(kept), std::string::npos) << kept << " in " << text;
  for (const char* drawn : {"'wall'", "'post'"})
    EXPECT_EQ(text.find(drawn), std::string::npos) << drawn;
  EXPECT_EQ(valueAt(-0.045, 1.5), kOccupied) << "the post is in the map";
}

TEST_F(MendMap, SaysWhyThereIsNoProposal) {
  tell("unsure.rec", {{true, false, 0.0, 0.0, 1, 0}});
  expectRefused(mendBy("unsure.rec"), 1, "ortung mend-map: " + path("unsure.rec"),
                {"nothing is sure to have changed (1 cells"});
  tell("other.rec", {{true, true, 0.0, 0.0, 2, 0}}, "0123456789abcdef");
  expectRefused(mendBy("other.rec"), 1, "ortung mend-map: " + path("other.rec"),
                {"is about the world 0123456789abcdef, but"});
  expectRefused(mendBy("hall.toml"), 1, "ortung mend-map: " + path("hall.toml"), {});
  expectRefused(mendBy("none"), 1, "ortung mend-map: " + path("none"), {});
  tell("sure.rec", {{true, true, 0.0, 0.0, 2, 0}});
  expectRefused(mendBy("sure.rec", {"--out", path("mended.yaml")}), 2, "ortung mend-map: ", {});
  EXPECT_FALSE(std::filesystem::exists(path("mended.toml")));
  write("mended.pgm", "my own");
  expectRefused(mendBy("sure.rec"), 1, "ortung mend-map: " + path("mended.pgm"), {"--force"});
  EXPECT_EQ(read("mended.pgm"), "my own");
}

}  // namespace
}  // namespace ortung::test
