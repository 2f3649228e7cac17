// Files that are made beside each other and then moved into place.
#include <gtest/gtest.h>

#include "Console.hpp"
#include "Files.hpp"
#include "ScratchFolder.hpp"
#include "Workshop.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;
using test::messageOf;
using test::readBytes;
using test::writeBytes;

class WorkshopTest : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_ / name; }
  /// A world with a map and a picture in a folder of its own.
  static void make(const Workshop& workshop) {
    writeBytes(workshop.file(), "the world");
    writeBytes(workshop.folder() / "map.yaml", "the map");
    fs::create_directory(workshop.folder() / "parts");
    writeBytes(workshop.folder() / "parts" / "map.pgm", std::string(3u << 20, 'p'));
  }
  test::TemporaryFolder folder_;
};

TEST_F(WorkshopTest, AllFilesAreDeliveredAndTheFolderGoes) {
  fs::path made;
  fs::create_directory(path("parts"));
  {
    const Workshop workshop("--world", path("hall.toml"));
    made = workshop.folder();
    EXPECT_EQ(workshop.file(), made / "hall.toml");
    make(workshop);
    Outputs outputs(false);
    outputs.writes("--world", path("hall.toml"), OutputKind::kSettings);
    workshop.declare(outputs);
    EXPECT_FALSE(fs::exists(path("map.yaml"))) << "nothing is there before it is delivered";
    workshop.deliver(outputs);
  }
  EXPECT_EQ(readBytes(path("hall.toml")), "the world");
  EXPECT_EQ(readBytes(path("map.yaml")), "the map");
  EXPECT_TRUE(readBytes(path("parts/map.pgm")) == std::string(3u << 20, 'p'));
  EXPECT_EQ(folder_.files(), 3u);
  EXPECT_FALSE(fs::exists(made));
}

TEST_F(WorkshopTest, FilesBesideTheTargetAreNotReplacedUnlessForced) {
  writeBytes(path("map.yaml"), "my own");
  const Workshop workshop("--world", path("hall.toml"));
  make(workshop);
  fs::create_directory(path("parts"));
  Outputs outputs(false);
  outputs.writes("--world", path("hall.toml"), OutputKind::kSettings);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { workshop.declare(outputs); }),
            path("map.yaml").string() + ": exists and would be overwritten; use --force");
  Outputs forced(true);
  forced.writes("--world", path("hall.toml"), OutputKind::kSettings);
  workshop.declare(forced);
  workshop.deliver(forced);
  EXPECT_EQ(readBytes(path("map.yaml")), "the map");
}

TEST_F(WorkshopTest, FilesBesideTheTargetAreNoOtherOutputs) {
  const Workshop workshop("--world", path("hall.toml"));
  writeBytes(workshop.file(), "the world");
  writeBytes(workshop.folder() / "run.rec", "");
  Outputs outputs(true);
  outputs.writes("--out", path("run.rec"), OutputKind::kRecord);
  outputs.writes("--world", path("hall.toml"), OutputKind::kSettings);
  EXPECT_EQ(messageOf<UsageError>([&] { workshop.declare(outputs); }),
            path("run.rec").string() + ": --out and --world name the same file, expected two");
}

TEST_F(WorkshopTest, ADeviceTakesOneFileButNoneBesideIt) {
  const Workshop alone("--out", "/dev/null");
  writeBytes(alone.file(), "text");
  Outputs outputs(false);
  outputs.writes("--out", "/dev/null", OutputKind::kSettings);
  alone.declare(outputs);
  alone.deliver(outputs);
  writeBytes(alone.folder() / "map.pgm", "");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { alone.declare(outputs); }),
            "/dev/null: map.pgm is made beside it, so it must be a file in a folder");
}

TEST(ScratchFolder, IsEmptyItsOwnAndGoesWithEverythingInIt) {
  fs::path one;
  {
    const ScratchFolder scratch;
    const ScratchFolder other;
    one = scratch.path();
    EXPECT_TRUE(fs::is_empty(one));
    EXPECT_NE(one, other.path());
    fs::create_directories(one / "a" / "b");
    writeBytes(one / "a" / "b" / "c", "text");
  }
  EXPECT_FALSE(fs::exists(one));
}

}  // namespace
}  // namespace ortung::app
