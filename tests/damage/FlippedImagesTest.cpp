// Every bit of maps of all formats, flipped.

#include "../sim/CarmenBytes.hpp"
#include "FlippedBits.hpp"
#include "GridMap.hpp"
#include "MapImage.hpp"
#include "SmallPngs.hpp"

namespace ortung {
namespace {

using test::Fate;
using test::flipBits;
using test::fromHex;
using test::TemporaryFolder;
using test::writeBytes;

/// Another byte for nearly every other pixel.
MapImage decode(const std::string& bytes) {
  return decodeImage("image", bytes, [](const MapPixel& pixel) {
    return static_cast<std::uint8_t>((pixel.colours * 40503u + pixel.alpha * 31u) >> 5u);
  });
}

Fate flipImage(const std::string& image) {
  return flipBits<MapError>(image, [](const std::string& bytes) {
    const MapImage read = decode(bytes);
    const auto n = static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height);
    EXPECT_EQ(read.meanings.size(), n);
  });
}

// A PNG has checksums, also of what is transparent: no bit of it may be another.
TEST(FlippedBits, OfPngs) {
  for (const std::string_view png : {test::kGrey, test::kBits, test::kPalette, test::kInterlaced}) {
    EXPECT_EQ(decode(fromHex(png)).meanings.size() % 2, 0u);
    EXPECT_EQ(flipImage(fromHex(png)).taken, 0);
  }
}

TEST(FlippedBits, OfPgmsAndPpms) {
  const std::string grey = "P5 # map\n3 2 255\n" + std::string("\xfe\xfe\0\xcd\xfe\xfe", 6);
  const std::string colours =
      "P6\n2 1\n65535\n" + std::string("\xfe\xfe\0\xcd\xfe\xfe\1\2\3\4\5\6", 12);
  const std::string plain = "P2 # map\n3 2 255\n254 254 0\n205 254 254\n";
  for (const std::string& image : {grey, colours, plain}) {
    const Fate fate = flipImage(image);
    EXPECT_GT(fate.taken, 0);
    EXPECT_GT(fate.refused, 0);
  }
}

TEST(FlippedBits, OfCarmenMapsAndYaml) {
  const TemporaryFolder folder;
  const auto flipMap = [&](const std::string& name, const std::string& whole) {
    const Fate fate = flipBits<MapError>(whole, [&](const std::string& bytes) {
      writeBytes(folder / name, bytes);
      const GridMap map = readGridMap(folder / name);
      EXPECT_EQ(map.cells.size(),
                static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    });
    EXPECT_GT(fate.taken, 0);
    EXPECT_GT(fate.refused, 0);
  };
  flipMap("a.map", test::carmenMap(3, 2, 0.5F, {0, 1, 0.1F, -1, 0.5F, 0.2F}));
  writeBytes(folder / "map.pgm", "P5 3 1 255\n" + std::string("\xfe\0\xcd", 3));
  flipMap("a.yaml",
          "image: map.pgm\nresolution: 0.5\norigin: [0, 1.5, 0]\nnegate: 0\n"
          "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n");
  flipMap("b.yaml", "image: map.pgm\nresolution: 0.5\norigin: [0, 1.5, 0.65]\nmode: raw\n");
}

}  // namespace
}  // namespace ortung
