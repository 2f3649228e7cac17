// Plays scenarios of the referee that are files: referee_scenarios [FOLDER] [--gtest_filter=...].
// Each file of the folder is a test of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "Paths.hpp"
#include "Scenario.hpp"

namespace {

using namespace ortung;
using namespace ortung::test;

class ScenarioTest : public testing::Test {
 public:
  explicit ScenarioTest(std::filesystem::path file) : file_(std::move(file)) {}
  void TestBody() override {
    const Scenario scenario = Scenario::read(file_, ORTUNG_SOURCE_DIR "/maps");
    for (const std::string& problem : play(scenario))
      ADD_FAILURE() << file_.filename().string() << " (" << scenario.about << ")\n  " << problem;
  }

 private:
  std::filesystem::path file_;
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::filesystem::path folder =
      argc > 1 ? argv[1] : ORTUNG_SOURCE_DIR "/tests/referee/scenarios";
  std::set<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") files.insert(entry.path());
  if (files.empty()) {
    std::fprintf(stderr, "%s: has no scenarios (*.toml)\n", folder.c_str());
    return 2;
  }
  for (const auto& file : files)
    testing::RegisterTest("Scenario", file.stem().c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [file]() -> ScenarioTest* { return new ScenarioTest(file); });
  return RUN_ALL_TESTS();
}
