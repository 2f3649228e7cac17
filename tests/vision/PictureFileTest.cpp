// Pictures of files: their sizes by their headers, and what is no picture.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <set>
#include <string>
#include <vector>

#include "Files.hpp"
#include "ortung/calibration/ImageFile.hpp"

namespace ortung {
namespace {

using namespace std::string_literals;

class PictureFile : public testing::Test {
 protected:
  std::string refusalOf(const std::string& bytes) {
    test::writeBytes(folder_ / "picture", bytes);
    return refusalOfFile(folder_ / "picture");
  }
  static std::string refusalOfFile(const std::filesystem::path& file) {
    try {
      readPicture(file);
    } catch (const std::runtime_error& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.starts_with(file.string() + ": ")) << text;
      EXPECT_EQ(text.find("OpenCV"), text.npos) << text;
      return text.substr(std::min(text.size(), file.string().size() + 2));
    }
    return "taken";
  }
  /// A grey PNG of some pixels.
  static std::string png(int width, int height) {
    const std::vector<std::uint8_t> pixels(
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 77);
    const auto bytes = toPng({{width, height}, PixelFormat::kGrey, pixels.data()});
    return {bytes.begin(), bytes.end()};
  }
  /// The same with another size in its header, whose checksum nothing looks at before the size.
  static std::string pngThatSays(std::uint32_t width, std::uint32_t height) {
    std::string bytes = png(8, 8);
    for (int i = 0; i < 4; ++i) {
      bytes[static_cast<std::size_t>(16 + i)] = static_cast<char>(width >> (24 - 8 * i) & 0xFF);
      bytes[static_cast<std::size_t>(20 + i)] = static_cast<char>(height >> (24 - 8 * i) & 0xFF);
    }
    return bytes;
  }
  test::TemporaryFolder folder_;
};

// By its size in memory it would have taken 1.2 GB before it was refused.
TEST_F(PictureFile, IsMeasuredByItsHeader) {
  rusage before{};
  ::getrusage(RUSAGE_SELF, &before);
  EXPECT_EQ(refusalOf(pngThatSays(40000, 10000)),
            "has 40000 x 10000 pixels, expected 1 to 4096 a side");
  EXPECT_EQ(refusalOf(pngThatSays(0xFFFFFFFF, 1)),
            "has 4294967295 x 1 pixels, expected 1 to 4096 a side");
  EXPECT_EQ(refusalOf(pngThatSays(0, 8)), "has 0 x 8 pixels, expected 1 to 4096 a side");
  // JPEG: an application's segment and a quantization table come before the frame.
  const std::string jpeg = "\xFF\xD8\xFF\xE0\x00\x04xx\xFF\xDB\x00\x03x\xFF\xFF\xC2\x00\x11\x08"s;
  EXPECT_EQ(refusalOf(jpeg + "\x27\x10\x9C\x40\x03\x01\x22\x00"s),
            "has 40000 x 10000 pixels, expected 1 to 4096 a side");
  EXPECT_EQ(refusalOf("BM" + std::string(12, '\0') + "\x28\0\0\0\x40\x9C\0\0\xF0\xD8\xFF\xFF"s),
            "has 40000 x 10000 pixels, expected 1 to 4096 a side");
  EXPECT_EQ(refusalOf("BM" + std::string(12, '\0') + "\x0C\0\0\0\x40\x9C\x10\x27\x01\0\x18\0"s),
            "has 40000 x 10000 pixels, expected 1 to 4096 a side");
  EXPECT_EQ(refusalOf("P5\n# a comment\n40000\t10000 255\n"),
            "has 40000 x 10000 pixels, expected 1 to 4096 a side");
  rusage after{};
  ::getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100'000) << "kB";
}

// ITU-T T.81, table B.1: SOF0 to SOF15, of which three codes are other segments.
TEST_F(PictureFile, OfAnyFrameOfJpegIsMeasured) {
  const std::set<int> frames{0xC0, 0xC1, 0xC2, 0xC3, 0xC5, 0xC6, 0xC7,
                             0xC9, 0xCA, 0xCB, 0xCD, 0xCE, 0xCF};
  for (int marker = 0; marker < 0xFF; ++marker) {
    const std::string bytes = "\xFF\xD8\xFF"s + static_cast<char>(marker) +
                              "\x00\x11\x08\x27\x10\x9C\x40\x03\x01\x22\x00"s;
    EXPECT_EQ(refusalOf(bytes),
              frames.contains(marker)
                  ? "has 40000 x 10000 pixels, expected 1 to 4096 a side"
                  : "has no header of a picture, expected a picture: JPEG, PNG, BMP, PGM or PPM")
        << std::hex << marker;
  }
}

TEST_F(PictureFile, IsOneOfTheFormatsThatAreRead) {
  for (const std::string& bytes :
       {""s, "\x89PNG"s, "\x89PNG\r\n\x1A\n\0\0\0\rIHD"s, "II*\0\x08\0\0\0"s, "GIF89a"s, "P5"s,
        "P5\nx 8 255\n"s, "P5 #"s, "BM"s, "\xFF\xD8\xFF"s, "\xFF\xD8\xFF\xD9"s, "text\n"s,
        "\xFF\xD8\xFF\xE0\xFF\xFF"s, "<VRTDataset rasterXSize=\"8\" rasterYSize=\"8\"/>"s})
    EXPECT_EQ(refusalOf(bytes),
              "has no header of a picture, expected a picture: JPEG, PNG, BMP, PGM or PPM")
        << bytes;
  EXPECT_EQ(refusalOf("P5\n8 8\n255\n" + std::string(64, 'x')), "taken");
  EXPECT_EQ(refusalOf("P6\n4 2\n255\n" + std::string(24, 'x')), "taken");
  EXPECT_EQ(refusalOf(png(64, 48)), "taken");
}

TEST_F(PictureFile, ThatIsDamagedIsSaidSo) {
  const std::string whole = png(64, 48);
  const std::string damaged = "is damaged: its 64 x 48 pixels can't be decoded";
  testing::internal::CaptureStderr();
  EXPECT_EQ(refusalOf(whole.substr(0, 40)), damaged);
  EXPECT_EQ(refusalOf("BM" + std::string(12, '\0') + "\x28\0\0\0\x40\0\0\0\x30\0\0\0"s), damaged);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "of the libraries that decode";
}

TEST_F(PictureFile, IsAFileThatEnds) {
  ASSERT_EQ(::mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  const std::string expected = "is no regular file, expected a picture: JPEG, PNG, BMP, PGM or PPM";
  EXPECT_EQ(refusalOfFile(folder_ / "fifo"), expected);
  EXPECT_EQ(refusalOfFile("/dev/zero"), expected);
  EXPECT_EQ(refusalOfFile(folder_.path()), expected);
  EXPECT_EQ(refusalOfFile(folder_ / "none"), "can't be read: No such file or directory");
}

}  // namespace
}  // namespace ortung
