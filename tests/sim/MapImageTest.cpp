// Images of all depths and kinds of pixels, made here by what their specifications say: PNG
// (W3C, sections 11.2 and 11.3) and netpbm (pgm(5), ppm(5)).
#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/zlib.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <cmath>
#include <sstream>

#include "GridMap.hpp"
#include "MapImage.hpp"

namespace ortung {
namespace {

namespace io = boost::iostreams;
using Bytes = std::vector<int>;

std::string stringOf(const Bytes& bytes) {
  std::string text;
  for (const int byte : bytes) text += static_cast<char>(byte);
  return text;
}

std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::string chunk(const std::string& kindAndData) {
  boost::crc_32_type crc;
  crc.process_bytes(kindAndData.data(), kindAndData.size());
  return bigEndian(static_cast<std::uint32_t>(kindAndData.size() - 4)) + kindAndData +
         bigEndian(crc.checksum());
}

enum Colour { kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6 };

struct Png {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  int depth = 8;
  Colour colour = kGrey;
  std::string chunks = "";  ///< before the pixels
  int interlaced = 0;

  std::string of(const std::vector<Bytes>& rows) const {
    std::string pixels;
    {
      io::filtering_ostream stream;
      stream.push(io::zlib_compressor());
      stream.push(io::back_inserter(pixels));
      for (const Bytes& row : rows) stream << '\0' << stringOf(row);  // not filtered
    }
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR" + bigEndian(width) + bigEndian(height) +
                 stringOf({depth, colour, 0, 0, interlaced})) +
           chunks + chunk("IDAT" + pixels) + chunk("IEND");
  }
};

std::vector<MapPixel> pixelsOf(const std::string& bytes) {
  std::vector<MapPixel> pixels;
  decodeImage("image", bytes, [&](const MapPixel& pixel) {
    pixels.push_back(pixel);
    return std::uint8_t{0};
  });
  return pixels;
}

std::string refusalOf(const std::string& bytes) {
  try {
    pixelsOf(bytes);
  } catch (const MapError& error) {
    return error.what();
  }
  return "";
}

/// One word for a pixel: the three colours in their sum, and alpha if it is not opaque.
std::string said(const std::vector<MapPixel>& pixels) {
  std::ostringstream text;
  for (const MapPixel& one : pixels) {
    text << (text.tellp() > 0 ? " " : "") << one.colours;
    if (one.alpha != MapPixel::kFull) text << "/" << one.alpha;
  }
  return text.str();
}

TEST(MapImage, GreyPngsOfAllDepths) {
  EXPECT_EQ(said(pixelsOf(Png{.width = 3, .depth = 1}.of({{0b10100000}}))), "196605 0 196605");
  EXPECT_EQ(said(pixelsOf(Png{.width = 2, .depth = 2}.of({{0b01110000}}))), "65535 196605");
  EXPECT_EQ(said(pixelsOf(Png{.width = 2, .depth = 4}.of({{0x1F}}))), "13107 196605");
  EXPECT_EQ(said(pixelsOf(Png{.width = 2}.of({{1, 255}}))), "771 196605");
  EXPECT_EQ(said(pixelsOf(Png{.width = 2, .depth = 16}.of({{0, 1, 0x12, 0x34}}))), "3 13980");
  EXPECT_EQ(said(pixelsOf(Png{.width = 1, .height = 2}.of({{7}, {9}}))), "5397 6939")
      << "the top row first";
}

TEST(MapImage, PngsWithColoursAndAlpha) {
  EXPECT_EQ(said(pixelsOf(Png{.colour = kRgb}.of({{1, 2, 4}}))), "1799");
  EXPECT_EQ(said(pixelsOf(Png{.depth = 16, .colour = kRgb}.of({{0, 1, 0, 2, 1, 0}}))), "259");
  EXPECT_EQ(said(pixelsOf(Png{.colour = kGreyAlpha}.of({{2, 128}}))), "1542/32896");
  EXPECT_EQ(said(pixelsOf(Png{.depth = 16, .colour = kGreyAlpha}.of({{0, 2, 0xFF, 0xFE}}))),
            "6/65534")
      << "the last bit of 16 counts";
  EXPECT_EQ(said(pixelsOf(Png{.width = 2, .colour = kRgba}.of({{1, 1, 1, 255, 0, 0, 1, 0}}))),
            "771 257/0");
  EXPECT_EQ(said(pixelsOf(Png{.depth = 16, .colour = kRgba}.of({{0, 1, 0, 1, 0, 1, 0xFF, 0xFF}}))),
            "3");
}

TEST(MapImage, PngsWithPalettesAndTransparentColours) {
  const std::string palette = chunk("PLTE" + stringOf({1, 2, 4, 0, 0, 0, 255, 255, 255}));
  const std::string alpha = chunk("tRNS" + stringOf({255, 0}));
  for (const auto& [depth, row] :
       {std::pair(2, Bytes{0b00011000}), {4, Bytes{0x01, 0x20}}, {8, Bytes{0, 1, 2}}}) {
    EXPECT_EQ(
        said(pixelsOf(
            Png{.width = 3, .depth = depth, .colour = kPalette, .chunks = palette}.of({row}))),
        "1799 0 196605");
    EXPECT_EQ(said(pixelsOf(
                  Png{.width = 3, .depth = depth, .colour = kPalette, .chunks = palette + alpha}.of(
                      {row}))),
              "1799 0/0 196605");
  }
  // Of grey and of colours one may be transparent.
  EXPECT_EQ(
      said(pixelsOf(Png{.width = 2, .depth = 16, .chunks = chunk("tRNS" + stringOf({1, 2}))}.of(
          {{1, 2, 1, 3}}))),
      "774/0 777");
}

TEST(MapImage, PngsAreReadWithoutGamma) {
  const std::string gamma = chunk("gAMA" + bigEndian(45455));
  EXPECT_EQ(said(pixelsOf(Png{.chunks = gamma}.of({{100}}))), "77100");
}

TEST(MapImage, APngIsReadToItsEnd) {
  const std::string whole = Png{.width = 2, .height = 2}.of({{1, 2}, {3, 4}});
  EXPECT_EQ(refusalOf(whole), "");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(refusalOf(whole.substr(0, size)), "") << size;
  EXPECT_NE(refusalOf(Png{.width = 2, .height = 2}.of({{1, 2}})).find("cannot be decoded"),
            std::string::npos)
      << "a row is missing";
  EXPECT_NE(refusalOf(Png{.colour = kPalette}.of({{0}})).find("cannot be decoded"),
            std::string::npos)
      << "there is no palette";
}

// Interlaced rows come as a whole, so the memory for them has a limit of its own.
TEST(MapImage, InterlacedPngsAreReadUpToALimit) {
  EXPECT_EQ(said(pixelsOf(Png{.interlaced = 1}.of({{7}}))), "5397");
  const std::string padding = chunk("tEXt" + std::string("a\0", 2) + std::string(600000, ' '));
  const Png large{8000, 8000, 16, kRgba, padding, 1};
  EXPECT_NE(refusalOf(large.of({})).find("interlaced pixels of 512000000 bytes, expected 2^27"),
            std::string::npos)
      << refusalOf(large.of({}));
}

std::string plainOf(const std::string& kind, std::uint32_t white,
                    const std::vector<std::uint32_t>& values, int width) {
  std::ostringstream text;
  text << kind << " # a comment\n" << width << " 1\n" << white;
  for (const std::uint32_t value : values) text << "\n" << value;
  return text.str();
}

std::string binaryOf(const std::string& kind, std::uint32_t white,
                     const std::vector<std::uint32_t>& values, int width) {
  std::string bytes = kind + " " + std::to_string(width) + " 1 " + std::to_string(white) + "\n";
  for (const std::uint32_t value : values) {
    if (white > 255) bytes += static_cast<char>(value >> 8);
    bytes += static_cast<char>(value & 255);
  }
  return bytes;
}

TEST(MapImage, PnmsOfAllDepthsPlainAndBinary) {
  for (const std::uint32_t white : {1u, 2u, 100u, 255u, 256u, 1000u, 65534u, 65535u}) {
    const auto scaled = [&](std::uint32_t value) {
      return static_cast<std::uint32_t>(std::lround(65535.0 * value / white));
    };
    const std::vector<std::uint32_t> greys{0, 1, white / 3, white};
    std::vector<MapPixel> expected;
    for (const std::uint32_t value : greys)
      expected.push_back({3 * scaled(value), MapPixel::kFull});
    EXPECT_EQ(said(pixelsOf(plainOf("P2", white, greys, 4))), said(expected)) << white;
    EXPECT_EQ(said(pixelsOf(binaryOf("P5", white, greys, 4))), said(expected)) << white;
    const std::vector<std::uint32_t> colours{0, 1, white, white / 2, white, white};
    expected = {{scaled(0) + scaled(1) + scaled(white), MapPixel::kFull},
                {scaled(white / 2) + 2 * scaled(white), MapPixel::kFull}};
    EXPECT_EQ(said(pixelsOf(plainOf("P3", white, colours, 2))), said(expected)) << white;
    EXPECT_EQ(said(pixelsOf(binaryOf("P6", white, colours, 2))), said(expected)) << white;
  }
}

TEST(MapImage, PlainPnmsMayHaveCommentsAnywhere) {
  EXPECT_EQ(said(pixelsOf("P2#a\n2#b\n2#c\r255 0#d\n1 #e\n#f\n  2\t255#g")), "0 771 1542 196605");
  EXPECT_EQ(said(pixelsOf("P2 1 1 100 9999999999999999999")), "196605") << "white at most";
}

TEST(MapImage, BrokenPnmsAreRefused) {
  const auto has = [](const std::string& bytes, const std::string& part) {
    EXPECT_NE(refusalOf(bytes).find(part), std::string::npos) << refusalOf(bytes);
  };
  for (const char* header : {"P2", "P3 1", "P2 1 1", "P5 1 1", "P2 a 1 1", "P2 #", "P6 1 # 1 1"})
    has(header, "has no complete PNM header");
  has("P2 2 1 255 1", "ends after 2 characters of pixels, expected 2 numbers");
  has("P2 2 1 255 100", "ends after 1 numbers, expected 2");
  has("P2 2 1 255 100 # 200", "ends after 1 numbers, expected 2");
  has("P2 2 1 255 100 x200", "has something else behind 1 numbers, expected 2");
  has("P2 2 1 255 100 -1", "has something else behind 1 numbers, expected 2");
  has("P3 1 1 255 1 2   ", "ends after 2 numbers, expected 3");
  has("P2 0 1 255 1", "0 x 1 cells");
  has("P2 1 1 0 1", "white is 0");
  has("P2 1 1 65536 1", "white is 65536");
  has("P3 100000 100000 255 1", "expected 1 to 2^26");
  has("P3 8000 8000 255 1", "ends after 2 characters of pixels, expected 192000000 numbers");
  has("P1 1 1 0", "not a known kind of image");
}

}  // namespace
}  // namespace ortung
