// Tables are found again by what they were made of.
#include <gtest/gtest.h>

#include <array>

#include "LearnedMaps.hpp"
#include "LogTesting.hpp"

namespace ortung::ros2 {
namespace {

class LearnedMapsTest : public ::testing::Test {
 protected:
  /// Learns tables of a key.
  std::string learn(std::uint64_t key) {
    const std::filesystem::path file = maps_.fileForNext();
    folder_.write(file.filename().string(), "tables");
    maps_.keep(key, file);
    return file.filename().string();
  }
  std::string found(std::uint64_t key) {
    const auto file = maps_.find(key);
    return file ? file->filename().string() : "";
  }
  testing::TemporaryFolder folder_;
  LearnedMaps maps_{folder_.path()};
};

TEST_F(LearnedMapsTest, KeysDifferByEachByteAndByWhereFilesEnd) {
  const auto keyOf = [&](const std::string& world, const std::string& robot) {
    return LearnedMaps::keyOf(
        std::array{folder_.write("map.toml", world), folder_.write("robot.toml", robot)});
  };
  EXPECT_EQ(keyOf("ab", "c"), keyOf("ab", "c"));
  EXPECT_NE(keyOf("ab", "c"), keyOf("ab", "d"));
  EXPECT_NE(keyOf("ab", "c"), keyOf("a", "bc"));
  EXPECT_THROW(LearnedMaps::keyOf(std::array{folder_.path() / "none"}), std::runtime_error);
}

TEST_F(LearnedMapsTest, TablesAreFoundUntilTheyAreGone) {
  EXPECT_EQ(found(1), "");
  const std::string first = learn(1);
  const std::string second = learn(2);
  EXPECT_NE(first, second);
  EXPECT_EQ(found(1), first);
  EXPECT_EQ(found(2), second);
  std::filesystem::remove(folder_.path() / first);
  EXPECT_EQ(found(1), "");
}

TEST_F(LearnedMapsTest, ThoseAskedForLongestAgoMakeRoom) {
  const std::string first = learn(1);
  const std::string second = learn(2);
  for (std::uint64_t key = 3; key <= LearnedMaps::kMost; ++key) learn(key);
  EXPECT_EQ(found(1), first);
  EXPECT_EQ(learn(100), second);
  EXPECT_EQ(found(2), "");
  EXPECT_EQ(found(1), first);
  EXPECT_EQ(found(100), second);
}

}  // namespace
}  // namespace ortung::ros2
