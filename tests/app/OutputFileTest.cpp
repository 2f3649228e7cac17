#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <string>

#include "OutputFile.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

class OutputFile : public testing::Test {
 protected:
  OutputFile() {
    std::string name = (fs::temp_directory_path() / "ortung-output-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~OutputFile() override { fs::remove_all(folder_); }
  static std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

TEST_F(OutputFile, ReplacesAFileAndLeavesNothingElse) {
  writeFile(folder_ / "a.txt", "old");
  writeFile(folder_ / "a.txt", "new");
  EXPECT_EQ(read(folder_ / "a.txt"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(OutputFile, NamesTheMissingFolderBeforeWorkBegins) {
  try {
    checkOutput(folder_ / "none" / "a.txt");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("there is no folder"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(checkOutput(folder_), std::runtime_error);
  EXPECT_NO_THROW(checkOutput(folder_ / "a.txt"));
}

TEST_F(OutputFile, LeavesTheOldFileIfTheNewOneCannotBeWritten) {
  writeFile(folder_ / "a.txt", "old");
  fs::create_directory(folder_ / "b");
  fs::create_directory(folder_ / "b" / "c");
  EXPECT_THROW(writeFile(folder_ / "b", "new"), std::runtime_error);  // a folder can't be replaced
  EXPECT_TRUE(fs::is_directory(folder_ / "b" / "c"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2);
}

}  // namespace
}  // namespace ortung::app
