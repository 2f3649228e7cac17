#include <gtest/gtest.h>

#include <cstdlib>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {
namespace {

using test::messageOf;
using test::TemporaryFolder;

const std::string kFolder = TEST_PLUGINS;
std::string pathOf(const std::string& library) { return kFolder + "/ortung_" + library + ".so"; }

std::string complaintOf(const std::string& file) {
  return messageOf<PluginError>([&] { PluginFactory().load(file); });
}

/// A factory that has only the library @p name in its search path.
struct Only {
  explicit Only(const std::string& name) {
    std::filesystem::create_symlink(pathOf(name), folder / ("ortung_" + name + ".so"));
  }
  TemporaryFolder folder;
  PluginFactory factory{{folder.path()}};
};

TEST(PluginFactory, RefusesAnotherAbi) {
  EXPECT_EQ(complaintOf(pathOf("bad_abi")),
            pathOf("bad_abi") + ": has plugin ABI 99, this program has 1; rebuild the plugin");
}

TEST(PluginFactory, RefusesAnotherToolchain) {
  const std::string told = complaintOf(pathOf("bad_tag"));
  EXPECT_TRUE(told.starts_with(
      pathOf("bad_tag") +
      ": was built with container 0.0.1, gcc4-cxx11abi0, this program with container "))
      << told;
  EXPECT_TRUE(told.ends_with("; rebuild the plugin")) << told;
}

TEST(PluginFactory, RefusesALibraryWithoutPlugins) {
  EXPECT_EQ(complaintOf(pathOf("bad_none")),
            pathOf("bad_none") + ": exports no ORTUNG_PLUGINS, so it is no plugin library");
}

TEST(PluginFactory, RefusesFilesThatAreNone) {
  const TemporaryFolder folder;
  EXPECT_EQ(complaintOf("nowhere.so"), "nowhere.so: can't be read: No such file or directory");
  const std::string text = folder / "text.so";
  test::writeBytes(text, std::string(1000, 'x'));
  EXPECT_EQ(complaintOf(text), text + ": is no 64-bit shared library");
  test::writeBytes(text, "");
  EXPECT_EQ(complaintOf(text), text + ": is no 64-bit shared library");
  EXPECT_EQ(complaintOf(folder.path()), folder.path().string() + ": can't be read: Is a directory");
}

TEST(PluginFactory, RefusesATornLibraryWhereverItIsTorn) {
  const TemporaryFolder folder;
  const std::string whole = test::readBytes(pathOf("good"));
  Random random(1);
  std::vector<std::size_t> sizes = {whole.size() - 1, whole.size() - 64, 63, 64, 4096};
  for (int i = 0; i < 100; ++i) sizes.push_back(random.below(whole.size()));
  for (const std::size_t size : sizes) {
    // Another name each time, since a library is loaded once.
    const std::string file = folder / ("torn" + std::to_string(size) + ".so");
    test::writeBytes(file, whole.substr(0, size));
    const std::string told = complaintOf(file);
    EXPECT_TRUE(told.starts_with(file + ": is torn: it has " + std::to_string(size) + " bytes") ||
                told == file + ": is no 64-bit shared library")
        << told;
    std::filesystem::remove(file);
  }
}

TEST(PluginFactory, RefusesAPluginOfYesterdaysInterface) {
  Only only("bad_interface");
  const std::string told =
      messageOf<PluginError>([&] { only.factory.makeData("yesterday", Parameters()); });
  EXPECT_NE(told.find(": plugin yesterday is of interface ortung.SensorData/0.0.1-00000000, this "
                      "program has ortung.SensorData/"),
            std::string::npos)
      << told;
}

TEST(PluginFactory, SaysWhereItLookedForAPlugin) {
  Only only("good");
  EXPECT_EQ(messageOf<PluginError>([&] { only.factory.makeData("lrf", Parameters()); }),
            "there is no plugin 'lrf' of kind ortung.SensorData; there are good (in " +
                only.folder.path().string() + ")");
  EXPECT_EQ(messageOf<PluginError>([&] { PluginFactory().make<MotionModel>("x", Parameters()); }),
            "there is no plugin 'x' of kind ortung.MotionModel; there is none (in the empty search "
            "path)");
}

TEST(PluginFactory, TakesNoPathForAName) {
  Only only("good");
  for (const std::string name : {"../good", "/etc/passwd", "", "good/../good", "GOOD", "."}) {
    EXPECT_THROW(only.factory.makeData(name, Parameters()), PluginError) << name;
  }
}

TEST(PluginFactory, NamesThePluginWhoseConstructorThrows) {
  Only only("strange");
  EXPECT_EQ(messageOf<PluginError>([&] { only.factory.makeData("throws_logic", Parameters()); }),
            "plugin 'throws_logic': vector::_M_range_check");
  EXPECT_EQ(messageOf<PluginError>([&] { only.factory.makeData("throws_number", Parameters()); }),
            "plugin 'throws_number': threw something that is no std::exception");
  EXPECT_EQ(messageOf<PluginError>([&] { only.factory.makeData("throws_runtime", Parameters()); }),
            "plugin 'throws_runtime': no light in the lamp");
  EXPECT_EQ(messageOf<std::invalid_argument>(
                [&] { only.factory.makeData("throws_argument", Parameters()); }),
            "beams without a step");
  Parameters p("r.toml");
  p.set("max_range_m", Parameters::Node{50.0, 4});
  EXPECT_EQ(messageOf<ConfigError>([&] { only.factory.makeData("throws_config", p); }),
            "r.toml:4: max_range_m is 50, must be in [0.1, 10]");
}

TEST(PluginFactory, RefusesAMisspeltParameter) {
  Only only("good");
  Parameters p("r.toml");
  p.set("cuont", Parameters::Node{3.0, 7});
  EXPECT_EQ(messageOf<ConfigError>([&] { only.factory.makeData("good", p); }),
            "r.toml:7: cuont is not known here (did you mean 'count'?); known are count");
  EXPECT_EQ(messageOf<ConfigError>([&] { only.factory.make<MotionModel>("good", p); }),
            "r.toml:7: cuont is not known here (did you mean 'count'?); known are count, step_m");
}

TEST(PluginFactory, MakesTwoKindsUnderOneName) {
  Only only("good");
  Parameters three;
  three.set("count", 3.0);
  EXPECT_EQ(only.factory.makeData("good", three).size(), 3u);
  const auto motion = only.factory.make<MotionModel>("good", Parameters());
  float x = 1.0F;
  motion->sampleMotion({{&x, 1}, {}, {}}, {}, 0, 0, 0);
  EXPECT_EQ(x, 2.0F);
}

TEST(PluginFactory, PluginsOutliveIt) {
  DeviceData data;
  {
    Only only("good");
    data = only.factory.makeData("good", Parameters());
  }
  ASSERT_EQ(data.size(), 2u);
  data[0]->setData(1, std::vector<std::uint32_t>{5});
  EXPECT_EQ(messageOf<std::invalid_argument>(
                [&] { data[1]->setData(1, std::vector<std::uint32_t>{5, 6}); }),
            "good/test/distance1: found 2 words, expected 1");
}

TEST(PluginFactory, ListsWhatThereIsAndWhatIsBroken) {
  PluginFactory factory({kFolder});
  const auto all = factory.list();
  ASSERT_EQ(all.size(), 6u);
  int broken = 0;
  for (const PluginFactory::Found& found : all) {
    broken += found.error.empty() ? 0 : 1;
    if (found.library != "good") continue;
    EXPECT_TRUE(found.error.empty());
    ASSERT_EQ(found.entries.size(), 2u);
    EXPECT_EQ(found.entries[0].name, "good");
    EXPECT_TRUE(found.entries[1].interface.starts_with("ortung.MotionModel/"));
  }
  EXPECT_EQ(broken, 3);
}

TEST(PluginFactory, ABrokenNeighbourDoesNotHideThePluginThatIsThere) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink(pathOf("bad_abi"), folder / "ortung_a.so");
  std::filesystem::create_symlink(pathOf("good"), folder / "ortung_z.so");
  PluginFactory factory({folder.path()});
  EXPECT_EQ(factory.makeData("good", Parameters()).size(), 2u);
  const std::string told = messageOf<PluginError>([&] { factory.makeData("lrf", Parameters()); });
  EXPECT_NE(told.find("there is no plugin 'lrf'"), std::string::npos) << told;
  EXPECT_NE(told.find("has plugin ABI 99"), std::string::npos)
      << "what could not be loaded is told: " << told;
}

// Not even for one of the same name in another folder: whoever put it there wants to know.
TEST(PluginFactory, ABrokenLibraryOfThePluginsNameIsTold) {
  const TemporaryFolder broken;
  const TemporaryFolder whole;
  std::filesystem::create_symlink(pathOf("bad_abi"), broken / "ortung_good_data.so");
  std::filesystem::create_symlink(pathOf("good"), whole / "ortung_good_data.so");
  PluginFactory factory({broken.path(), whole.path()});
  const std::string told = messageOf<PluginError>([&] { factory.makeData("good", Parameters()); });
  EXPECT_NE(told.find((broken / "ortung_good_data.so").string() + ": has plugin ABI 99"),
            std::string::npos)
      << told;
}

TEST(PluginFactory, SearchesTheFoldersOfTheEnvironmentFirst) {
  ::setenv("ORTUNG_PLUGIN_PATH", "/a::/b c", 1);
  const auto folders = PluginFactory::standardFolders();
  ASSERT_EQ(folders.size(), 3u);
  EXPECT_EQ(folders[0], "/a");
  EXPECT_EQ(folders[1], "/b c");
  EXPECT_TRUE(folders[2].string().ends_with("lib/ortung/plugins"));
}

TEST(PluginFactory, FindsPluginsBesideItsLibraryWhereverTheProgramIs) {
  ::unsetenv("ORTUNG_PLUGIN_PATH");
  const auto folders = PluginFactory::standardFolders();
  ASSERT_EQ(folders.size(), 1u);
  EXPECT_EQ(folders[0], std::filesystem::canonical(ORTUNG_PLUGINS_DIR));
}

}  // namespace
}  // namespace ortung
