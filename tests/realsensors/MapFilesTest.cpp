/// Copies of maps beside the worlds that are made of logs.

#include "LogTesting.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/realsensors/MapFiles.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

class MapFiles : public ::testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  std::string bytes(const std::string& name) const { return readBytes(path(name)); }
  std::string errorOfWorld(const std::string& map) const {
    return errorOf([&] { writeGridWorld(path("out/w.toml"), path(map)); });
  }
  TemporaryFolder folder_;
};

TEST_F(MapFiles, MapsOfOtherKindsKeepTheirEndingsAndBytes) {
  folder_.write("out/keep", "");
  for (const auto& [name, copy] : {std::pair{"hall.gridmap", "w.gridmap"},
                                   {"hall.gridmap.gz", "w.gridmap.gz"},
                                   {"hall.map", "w.map"},
                                   {"hall.map.gz", "w.map.gz"}}) {
    const std::string content = std::string("bytes\0of ", 9) + name;
    folder_.write(name, content);
    writeGridWorld(path("out/w.toml"), path(name), "\n[[landmark]]\nkind = \"x\"\n");
    EXPECT_EQ(bytes(std::string("out/") + copy), content) << name;
    EXPECT_EQ(
        bytes("out/w.toml"),
        "[world]\nname = \"w\"\n\n[[grid]]\nmap = \"" + std::string(copy) +
            "\"\nsurface_depth_cells = 0.5\nmap_error_m = 0.02\n\n[[landmark]]\nkind = \"x\"\n");
  }
  EXPECT_NE(errorOfWorld("gone.map").find((path("gone.map")).string() + ": "), std::string::npos);
}

// Whatever stands in the YAML, the image's line alone changes.
TEST_F(MapFiles, TheImagesLineNamesTheCopy) {
  folder_.write("out/keep", "");
  folder_.write("m.png", "\x89PNG...");
  for (const std::string line :
       {"image: m.png", "image:m.png  ", "image: \"m.png\"", "image:\t'm.png'\r"}) {
    folder_.write("a.yml", "# image: other.pgm\n" + line + "\nnegate: 0\n  image: far.pgm");
    writeGridWorld(path("out/w.toml"), path("a.yml"));
    EXPECT_EQ(bytes("out/w.yaml"),
              "# image: other.pgm\nimage: w.png\nnegate: 0\n  image: far.pgm\n")
        << line;
  }
  EXPECT_EQ(bytes("out/w.png"), "\x89PNG...");
}

TEST_F(MapFiles, PackedImagesAreUnpackedAndPlainPicturesOfTextAreTakenToo) {
  folder_.write("out/keep", "");
  folder_.write("m.pgm.xz", compressedXz("P2\n1 1\n255\n7\n"));
  folder_.write("a.yaml", "image: m.pgm\n");
  writeGridWorld(path("out/w.toml"), path("a.yaml"));
  EXPECT_EQ(bytes("out/w.pgm"), "P2\n1 1\n255\n7\n");
  folder_.write("m.pgm.xz", compressedXz("P6\n1 1\n255\nabc"));
  writeGridWorld(path("out/w.toml"), path("a.yaml"));
  EXPECT_EQ(bytes("out/w.pgm"), "P6\n1 1\n255\nabc");
  folder_.write("m.pgm.xz", compressedXz("P1\n1 1\n0\n"));
  EXPECT_EQ(errorOfWorld("a.yaml"),
            path("m.pgm.xz").string() + ": found no PGM, PPM or PNG image, expected one");
}

TEST_F(MapFiles, AYamlIsShort) {
  folder_.write("out/keep", "");
  folder_.write("m.pgm", "P5\n1 1\n255\na");
  const std::string start = "image: m.pgm\n#";
  folder_.write("a.yaml", start + std::string((64U << 10) - start.size(), 'x'));
  EXPECT_EQ(errorOfWorld("a.yaml"), "");
  folder_.write("a.yaml", start + std::string((64U << 10) - start.size() + 1, 'x'));
  EXPECT_EQ(errorOfWorld("a.yaml"), path("a.yaml").string() +
                                        ": found more than 65536 bytes (decompressed), expected "
                                        "no more");
}

TEST_F(MapFiles, LandmarksHaveTwoOrThreeCoordinates) {
  const auto file = folder_.write("b.txt", "# id x y z\n1 -1.5 2\n1000000 3 4 0.5 more\n");
  EXPECT_EQ(
      landmarksToml(file, "beacon"),
      "\n[[landmark]]\nkind = \"beacon\"\nidentity = 1\nposition_m = [-1.5, 2.0]\n"
      "\n[[landmark]]\nkind = \"beacon\"\nidentity = 1000000\nposition_m = [3.0, 4.0, 0.5]\n");
  EXPECT_EQ(landmarksToml(folder_.write("none.txt", "# none\n"), "beacon"), "");
  const auto complaint = [&](const std::string& line) {
    return errorOf([&] { landmarksToml(folder_.write("b.txt", line), "beacon"); });
  };
  EXPECT_EQ(complaint("1 2\n"),
            file.string() + ":1: found 2 fields, expected 3: identity, x, y [m]");
  EXPECT_EQ(complaint("-1 2 3\n"), file.string() +
                                       ":1: found '-1' in field 1, expected an identity, a "
                                       "number in [0, 1000000]");
  EXPECT_NE(complaint("1 2 3 high\n").find("'high' in field 4, expected z [m]"), std::string::npos);
}

TEST_F(MapFiles, AnOptionsFileIsLookedForInTheLogsFolderThenAsItIs) {
  folder_.write("log/near.txt", "");
  folder_.write("log/both.txt.gz", "");
  folder_.write("far.txt.xz", "");
  Parameters options("options");
  options.set("a", "near.txt");
  options.set("b", "both.txt");
  options.set("c", path("far.txt").string());
  options.set("d", "nowhere.txt");
  EXPECT_EQ(fileOption(options, "a", path("log")), path("log/near.txt"));
  EXPECT_EQ(fileOption(options, "b", path("log")), path("log/both.txt.gz"));
  EXPECT_EQ(fileOption(options, "c", path("log")), path("far.txt.xz"));
  EXPECT_EQ(fileOption(options, "none", path("log")), std::filesystem::path());
  const std::string error = errorOf([&] { fileOption(options, "d", path("log")); });
  EXPECT_NE(error.find("d found no file 'nowhere.txt' in " + path("log").string() +
                       " or the working directory, expected one (it may end in .xz or .gz)"),
            std::string::npos)
      << error;
}

}  // namespace
}  // namespace ortung
