// Formats of occupancy grids: what they mean, and how broken ones are refused.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <boost/crc.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <cstdlib>

#include "../damage/SmallPngs.hpp"
#include "CarmenBytes.hpp"
#include "WorldFiles.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace ortung::test {
namespace {

namespace io = boost::iostreams;

template <class Filter>
std::string packed(const std::string& plain) {
  std::string out;
  {
    io::filtering_ostream stream;
    stream.push(Filter());
    stream.push(io::back_inserter(out));
    stream << plain;
  }
  return out;
}

std::string pngOf(int width, int height, int channels, const std::vector<unsigned char>& pixels) {
  std::string png;
  stbi_write_png_to_func(
      [](void* out, void* data, int size) {
        static_cast<std::string*>(out)->append(static_cast<char*>(data),
                                               static_cast<std::size_t>(size));
      },
      &png, width, height, channels, pixels.data(), width * channels);
  return png;
}

/// Makes a PNG's header say that it has @p edge x @p edge pixels, with the checksum that fits.
void resize(std::string& png, std::uint32_t edge) {
  const auto put = [&png](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) png[at + i] = static_cast<char>(value >> (24 - 8 * i));
  };
  put(16, edge);
  put(20, edge);
  boost::crc_32_type crc;
  crc.process_bytes(png.data() + 12, 17);
  put(29, crc.checksum());
}

class MapFiles : public ::testing::Test {
 protected:
  /// Open cells of a world of this map, one character a cell, rows from top to bottom.
  std::string openOf(const std::string& map, double cell = 0.5) {
    const auto world =
        readWorld(folder.write("world.toml", gridWorld(map, "unknown_margin_m = 0\n")));
    const FieldRegion region = world->region(cell, {0});
    std::string picture;
    for (int row = region.grid.rows - 1; row >= 0; --row) {
      for (int column = 0; column < region.grid.columns; ++column)
        picture += region.open[static_cast<std::size_t>(row * region.grid.columns + column)] != 0
                       ? '.'
                       : '#';
      picture += row > 0 ? "/" : "";
    }
    return picture;
  }
  std::string refusal(const std::string& map) {
    return refusalOf(folder.write("world.toml", gridWorld(map)));
  }
  /// The refusal of a map_server map with this YAML and image.
  std::string refusal(const std::string& yaml, const std::string& pgm) {
    folder.write("map.pgm", pgm);
    folder.write("map.yaml", yaml);
    return refusal("map.yaml");
  }

  TemporaryFolder folder;
  const std::string image = pgmOf({"..#", ".#.", "...", "#  "});
};

#define EXPECT_HAS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

TEST_F(MapFiles, MapServerImagesLieTopDown) {
  folder.write("map.pgm", image);
  folder.write("map.yaml", mapYaml());
  EXPECT_EQ(openOf("map.yaml"), "..#/.#./.../###");
}

TEST_F(MapFiles, ImagesMayBePacked) {
  folder.write("a.pgm.gz", packed<io::gzip_compressor>(image));
  folder.write("b.pgm.xz", packed<io::lzma_compressor>(image));
  folder.write("a.yaml", mapYaml("a.pgm"));
  folder.write("b.yaml", mapYaml("b.pgm"));
  EXPECT_EQ(openOf("a.yaml"), "..#/.#./.../###");
  EXPECT_EQ(openOf("b.yaml"), "..#/.#./.../###");
}

TEST_F(MapFiles, ImagesMayBePngOfAnyDepthAndTransparent) {
  folder.write("grey.png", pngOf(2, 2, 1, {254, 0, 205, 254}));
  folder.write("rgb.png", pngOf(2, 2, 3, {254, 254, 254, 0, 0, 0, 205, 205, 205, 254, 254, 254}));
  folder.write("rgba.png", pngOf(2, 1, 4, {254, 254, 254, 255, 254, 254, 254, 0}));
  folder.write("grey.yaml", mapYaml("grey.png"));
  folder.write("rgb.yaml", mapYaml("rgb.png"));
  folder.write("rgba.yaml", mapYaml("rgba.png"));
  EXPECT_EQ(openOf("grey.yaml"), ".#/#.");
  EXPECT_EQ(openOf("rgb.yaml"), ".#/#.");
  EXPECT_EQ(openOf("rgba.yaml"), ".#");
}

TEST_F(MapFiles, NegatedImagesAreLightWhereOccupied) {
  folder.write("map.pgm", "P5 2 1 255\n" + std::string("\xff\x00", 2));
  folder.write("map.yaml", "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 1\n");
  EXPECT_EQ(openOf("map.yaml"), "#.");
}

TEST_F(MapFiles, BrokenYamlIsRefusedWithItsPlace) {
  EXPECT_HAS(refusal("image: [", image), "is not the YAML");
  EXPECT_HAS(refusal("just text", image), "expected keys and values");
  EXPECT_HAS(refusal("image: map.pgm\norigin: [0, 0, 0]\n", image), "has no resolution");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[0, 0, 2e4]"), image), "yaw of origin is 2e4, expected");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[0, 0, 2e4]"), image), "map.yaml:3");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[0, 0]"), image), "origin must be [x, y, yaw]");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[0, .nan, 0]"), image), "y of origin is .nan");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[0, 9999.9, 0]"), image), "beyond 10 km");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[0, 0, 0]", "0"), image), "resolution is 0, expected");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[0, 0, 0]", "wide"), image),
             "resolution is wide, expected");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[left, 0, 0]"), image), "x of origin is left, expected");
  EXPECT_HAS(refusal(mapYaml("map.pgm", "[0, 0, [0]]"), image), "yaw of origin is no number");
  for (const char* key : {"occupied_thresh", "free_thresh"})
    EXPECT_HAS(refusal("image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n" + std::string(key) +
                           ": dark\n",
                       image),
               std::string(key) + " is dark, expected");
  EXPECT_HAS(refusal(mapYaml() + "mode: grey\n", image),
             "mode is \"grey\", expected trinary, scale or raw");
  EXPECT_HAS(refusal("image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 2\n", image),
             "negate must be 0 or 1");
  EXPECT_HAS(
      refusal("image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nfree_thresh: 0.9\n", image),
      "free_thresh is above");
  EXPECT_HAS(refusal(std::string(100000, '#'), image), "has 100000 bytes, expected at most");
  EXPECT_HAS(refusal(std::string(60000, '['), image), "is not the YAML");
}

TEST_F(MapFiles, NumbersOfAYamlHaveLimits) {
  const auto yaml = [](const std::string& occupied, const std::string& free,
                       const std::string& resolution, const std::string& origin) {
    return "image: map.pgm\nresolution: " + resolution + "\norigin: " + origin +
           "\noccupied_thresh: " + occupied + "\nfree_thresh: " + free + "\n";
  };
  const std::string home = "[0, 0, 0]";
  for (const auto& fine :
       {yaml("0", "0", "0.5", home), yaml("1", "1", "0.5", home), yaml("0.6", "0.2", "0.001", home),
        yaml("0.6", "0.2", "100", home), yaml("0.6", "0.2", "0.5", "[-1e4, -1e4, 1e-9]")})
    EXPECT_EQ(refusal(fine, image), "") << fine;
  EXPECT_HAS(refusal(yaml("1.001", "0", "0.5", home), image), "occupied_thresh is 1.001, expected");
  EXPECT_HAS(refusal(yaml("-0.001", "0", "0.5", home), image), "occupied_thresh is -0.001, ");
  EXPECT_HAS(refusal(yaml("1", "1.001", "0.5", home), image), "free_thresh is 1.001, expected a ");
  EXPECT_HAS(refusal(yaml("1", "-0.001", "0.5", home), image), "free_thresh is -0.001, expected");
  EXPECT_HAS(refusal(yaml("1", "0", "0.0009", home), image), "resolution is 0.0009, expected a ");
  EXPECT_HAS(refusal(yaml("1", "0", "100.1", home), image), "resolution is 100.1, expected a ");
  EXPECT_HAS(refusal(yaml("1", "0", "0.5", "[-10001, 0, 0]"), image), "x of origin is -10001, ");
  EXPECT_HAS(refusal(yaml("1", "0", "0.5", "[10001, 0, 0]"), image), "x of origin is 10001, ");
  EXPECT_HAS(refusal(yaml("1", "0", "0.5", "[0, 10001, 0]"), image), "y of origin is 10001, ");
  EXPECT_EQ(refusal(yaml("1", "0", "0.5", "[0, 0, 1e4]"), image), "");
  EXPECT_HAS(refusal(yaml("1", "0", "0.5", "[0, 0, 10001]"), image), "yaw of origin is 10001");
}

TEST_F(MapFiles, MissingAndOddFilesAreRefused) {
  EXPECT_HAS(refusal(mapYaml("gone.pgm"), image), "gone.pgm does not exist, nor with .gz or .xz");
  EXPECT_HAS(refusal("gone.yaml"), "no such file");
  EXPECT_HAS(refusal("map.jpg"), "not a known kind of map");
  ASSERT_EQ(::mkfifo((folder.path() / "pipe.yaml").c_str(), 0600), 0);
  EXPECT_HAS(refusal("pipe.yaml"), "is not a regular file");
  EXPECT_HAS(refusal(mapYaml("."), image), "is not a regular file");
}

TEST_F(MapFiles, BrokenImagesAreRefused) {
  EXPECT_HAS(refusal(mapYaml(), "no image"), "not a known kind of image");
  EXPECT_HAS(refusal(mapYaml(), ""), "not a known kind of image");
  EXPECT_HAS(refusal(mapYaml(), image.substr(0, image.size() - 1)),
             "ends after 11 bytes of pixels, expected 12");
  EXPECT_HAS(refusal(mapYaml(), "P5 2 1 65536\nabcd"), "white is 65536");
  EXPECT_HAS(refusal(mapYaml(), "P5 2 1 0\nab"), "white is 0");
  EXPECT_HAS(refusal(mapYaml(), "P4 1 1\n0"), "not a known kind of image");
  const std::string png = pngOf(2, 2, 1, {254, 0, 205, 254});
  EXPECT_HAS(refusal(mapYaml(), png.substr(0, png.size() / 2)), "cannot be decoded");
  folder.write("torn.pgm.gz", packed<io::gzip_compressor>(image).substr(0, 20));
  EXPECT_HAS(refusal(mapYaml("torn.pgm"), image), "cannot be unpacked");
  folder.write("odd.pgm.xz", "no xz");
  EXPECT_HAS(refusal(mapYaml("odd.pgm"), image), "cannot be unpacked");
}

TEST_F(MapFiles, ImageBombsAreRefusedBeforeDecoding) {
  EXPECT_HAS(refusal(mapYaml(), "P5 100000 100000 255\nx"),
             "100000 x 100000 cells, expected 1 to 2^26");
  // A PNG header of 16000 x 16000 pixels and nothing else.
  std::string png = pngOf(2, 2, 1, {254, 0, 205, 254});
  resize(png, 16000);
  EXPECT_HAS(refusal(mapYaml(), png), "16000 x 16000 cells");
  // 288 MB of zeros, as nine members of one file.
  const std::string member = packed<io::gzip_compressor>(std::string(std::size_t{32} << 20, '\0'));
  std::string zeros;
  for (int i = 0; i < 9; ++i) zeros += member;
  folder.write("bomb.pgm.gz", zeros);
  EXPECT_HAS(refusal(mapYaml("bomb.pgm"), image), "unpacks to more than");
}

TEST_F(MapFiles, APngThatIsTooSmallForItsPixelsIsRefusedBeforeMemoryIsTaken) {
  // 8000 x 8000 pixels fit the limit of maps, but not 75 bytes, not even deflated.
  std::string png = pngOf(2, 2, 1, {254, 0, 205, 254});
  resize(png, 8000);
  EXPECT_HAS(refusal(mapYaml(), png), "cannot hold the 8000 x 8000 pixels of its header");
}

// One flipped bit of a valid file: the length of its last chunk but one is 0x8000002a.
TEST_F(MapFiles, APngWithAChunkOfAnImpossibleLengthIsRefused) {
  std::string png = fromHex(kGrey);
  const std::size_t length = png.find("IDAT") - 4;
  png[length] = static_cast<char>(0x80);
  EXPECT_HAS(refusal(mapYaml(), png), "the image cannot be decoded: ");
}

TEST_F(MapFiles, PngsOfAllKindsOfPixelsAreRead) {
  const auto openOfPng = [&](std::string_view png) {
    folder.write("kind.png", fromHex(png));
    folder.write("kind.yaml", mapYaml("kind.png"));
    return openOf("kind.yaml");
  };
  EXPECT_EQ(openOfPng(kGrey), "..#/#..");
  EXPECT_EQ(openOfPng(kBits), "..#/#..");
  EXPECT_EQ(openOfPng(kPalette), ".##/##.");
  EXPECT_EQ(openOfPng(kInterlaced), ".#/.#");
}

TEST_F(MapFiles, PnmOfOtherDepthsAreRead) {
  const auto openOfPnm = [&](const std::string& pnm) {
    folder.write("map.pgm", pnm);
    folder.write("map.yaml", mapYaml());
    return openOf("map.yaml");
  };
  EXPECT_EQ(openOfPnm("P5 3 1 100\n" + std::string("\x64\x00\x50", 3)), ".##");
  // 65024, 0, 255: the first byte is the greater one.
  EXPECT_EQ(openOfPnm("P5 3 1 65535\n" + std::string("\xfe\x00\x00\x00\x00\xff", 6)), ".##");
  EXPECT_EQ(openOfPnm("P5 2 1 1\n" + std::string("\x01\x00", 2)), ".#");
  EXPECT_EQ(openOfPnm("P6 2 1 255\n" + std::string("\xfe\xfe\xfe\xfe\x00\x00", 6)), ".#");
  EXPECT_EQ(openOfPnm("P5 # a comment\n2 # 2 by\n 1 255 " + std::string("\xfe\x00", 2)), ".#");
}

TEST_F(MapFiles, APngWhosePixelsUnpackToFarMoreThanItsSizeIsRefused) {
  // The compressed pixels of a large image under the header of a small one.
  const std::string large = pngOf(4000, 4000, 1, std::vector<unsigned char>(16000000, 0));
  std::string png = large;
  resize(png, 2);
  EXPECT_HAS(refusal(mapYaml(), png), "cannot be decoded");
}

TEST_F(MapFiles, CarmenMapsRunUpwardsByColumns) {
  folder.write("a.map", carmenMap(3, 2, 0.5f, {0, 1, 0.1f, -1, 0.5f, 0.2f}));
  EXPECT_EQ(openOf("a.map"), "##./..#");
  folder.write("a.map.gz", packed<io::gzip_compressor>(carmenMap(1, 2, 0.5f, {0, 1})));
  EXPECT_EQ(openOf("a.map.gz"), "#/.");
}

TEST_F(MapFiles, OtherChunksOfCarmenMapsMayBeEmpty) {
  const std::string label = "CARMENMAPFILEv020";
  const auto withChunk = [&](std::int32_t length) {
    std::string bytes = carmenMap(1, 2, 0.5f, {0, 1});
    bytes.insert(bytes.find(label) + label.size(), '\x10' + bytesOf(length));
    folder.write("a.map", bytes);
  };
  withChunk(0);
  EXPECT_EQ(openOf("a.map"), "#/.");
  withChunk(-1);
  EXPECT_HAS(refusal("a.map"), "a chunk of -1 bytes");
}

TEST_F(MapFiles, BrokenCarmenMapsAreRefusedWithTheirPlace) {
  const auto refusalOfBytes = [&](const std::string& bytes) {
    folder.write("a.map", bytes);
    return refusal("a.map");
  };
  const std::string good = carmenMap(3, 2, 0.5f, {0, 1, 0, 0, 0, 0});
  EXPECT_HAS(refusalOfBytes("# only a comment"), "ends within a comment");
  EXPECT_HAS(refusalOfBytes("BEESOFT"), "expected \"CARMENMAPFILEv020\"");
  EXPECT_HAS(refusalOfBytes(good.substr(0, 30)), "the file ends");
  EXPECT_HAS(refusalOfBytes(good.substr(0, good.size() - 3)), "the file ends 3 bytes early");
  EXPECT_HAS(refusalOfBytes("CARMENMAPFILEv020"), "has no grid");
  EXPECT_HAS(refusalOfBytes(carmenMap(3, 3, 0.5f, {0, 1, 0, 0, 0, 0})), "ends 12 bytes early");
  EXPECT_HAS(refusalOfBytes(carmenMap(100000, 100000, 0.5f, {})), "expected 1 to 2^26");
  EXPECT_HAS(refusalOfBytes(carmenMap(-1, 5, 0.5f, {})), "-1 x 5 cells");
  EXPECT_HAS(refusalOfBytes(carmenMap(1, 1, 0, {0})), "resolution is 0");
  EXPECT_HAS(refusalOfBytes(carmenMap(1, 1, std::nanf(""), {0})), "resolution is nan");
  EXPECT_HAS(refusalOfBytes(carmenMap(1, 1, 0.5f, {7})), "a cell is 7, expected -1");
  EXPECT_HAS(refusalOfBytes(carmenMap(1, 1, 0.5f, {std::nanf("")})), "a cell is nan");
}

/// MRPT's grid maps come from a program, here one that says what the test wants.
class MrptMaps : public MapFiles {
 protected:
  void SetUp() override {
    ::setenv("ORTUNG_LIBEXEC", folder.path().c_str(), 1);
    folder.write("map.gridmap.gz", "anything");
  }
  void TearDown() override { ::unsetenv("ORTUNG_LIBEXEC"); }
  void reader(const std::string& script) {
    const auto file = folder.write("ortung-mrpt-reader", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
};

TEST_F(MrptMaps, ComeFromTheReader) {
  reader(
      "test \"$1\" = gridmap || exit 9\ntest -f \"$2\" || exit 8\n"
      "printf 'ortung-gridmap 3 2 0.5 -1 2\\n\\377\\000\\177\\200\\240\\140'");
  EXPECT_EQ(openOf("map.gridmap.gz"), "#.#/.##");
}

TEST_F(MrptMaps, AreRefusedWithTheReadersOwnWords) {
  reader("echo '# error no such class'; exit 3");
  EXPECT_HAS(refusal("map.gridmap.gz"), "ended with status 3: no such class");
  reader("kill -SEGV $$");
  EXPECT_HAS(refusal("map.gridmap.gz"), "was ended by signal 11");
  reader("echo something else");
  EXPECT_HAS(refusal("map.gridmap.gz"), "answered \"something else\"");
  reader("printf 'ortung-gridmap 3 2 0.5 -1 2\\nabc'");
  EXPECT_HAS(refusal("map.gridmap.gz"), "expected a line and 6 cells");
  for (const char* cells : {"", "abcde", "abcdefg"}) {
    reader(std::string("printf 'ortung-gridmap 3 2 0.5 -1 2\\n") + cells + "'");
    EXPECT_HAS(refusal("map.gridmap.gz"), "expected a line and 6 cells");
  }
  reader("printf 'ortung-gridmap 4 7 0.5 -1 2 '");  // 28 bytes, but no line
  EXPECT_HAS(refusal("map.gridmap.gz"), "gave 28 bytes, expected a line and 28 cells");
  reader("printf 'ortung-gridmap 99999 99999 0.5 -1 2\\n'");
  EXPECT_HAS(refusal("map.gridmap.gz"), "expected 1 to 2^26");
  reader("printf 'ortung-gridmap 1 1 nan -1 2\\na'");
  EXPECT_HAS(refusal("map.gridmap.gz"), "ortung-gridmap");
  for (const char* place : {"nan 2", "-1 nan", "inf 2", "-1 -inf"}) {
    reader(std::string("printf 'ortung-gridmap 1 1 0.5 ") + place + "\\na'");
    EXPECT_HAS(refusal("map.gridmap.gz"), "ortung-gridmap");
  }
  reader("cat /dev/zero");
  EXPECT_HAS(refusal("map.gridmap.gz"), "ortung-mrpt-reader wrote more than 67109120 bytes");
}

TEST_F(MrptMaps, NeedTheReader) {
  const std::string message = refusal("map.gridmap.gz");
  EXPECT_HAS(message,
             "the program ortung-mrpt-reader is needed, which is not in " + folder.path().string());
  EXPECT_HAS(message, "ORTUNG_LIBEXEC");
  EXPECT_HAS(refusal("gone.gridmap"), "no such file");
}

}  // namespace
}  // namespace ortung::test
