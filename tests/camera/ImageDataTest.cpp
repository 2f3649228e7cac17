#include <gtest/gtest.h>

#include "Cameras.hpp"
#include "StrangerData.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/core/ReadingAs.hpp"

namespace ortung {
namespace {

const SensorId kId{"cam", "camera", "image"};

TEST(ImageData, KeepsPicturesAsTheyLieInMemory) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 5 * 3 * 3; ++i) pixels.push_back(static_cast<std::uint8_t>(i * 7));
  const auto words = ImageData::encode({{5, 3}, PixelFormat::kRgb, pixels.data()});
  ASSERT_EQ(words.size(), 3U + 12U);
  EXPECT_EQ(words[3], 0x150e0700U);  // 0, 7, 14, 21: the first byte is the lowest
  ImageData data(kId, {});
  EXPECT_EQ(data.reading().pixels, nullptr);
  data.setData(100, words);
  const ImageView view = data.reading();
  EXPECT_EQ(view.size, (ImageSize{5, 3}));
  EXPECT_EQ(view.bytes(), pixels.size());
  EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), view.pixels));
  EXPECT_FALSE(data.canWeigh());
}

TEST(ImageData, APictureOfAnotherClassIsReadInTheWordsOfThatFeature) {
  const std::vector<std::uint8_t> pixels = {1, 2, 3, 4, 5, 6};
  test::StrangerData stranger("image width=3 height=2");
  stranger.setData(7, ImageData::encode({{3, 2}, PixelFormat::kGrey, pixels.data()}));
  const auto view = readingAs<ImageData>(stranger);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->size, (ImageSize{3, 2}));
  EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), view->pixels));
  EXPECT_EQ(static_cast<const void*>(view->pixels), &stranger.getData()[ImageData::kHeaderWords]);
  stranger.setData(8, std::vector<std::uint32_t>{3, 2, 1, 0});  // a word too few
  EXPECT_FALSE(readingAs<ImageData>(stranger));
}

TEST(ImageData, RefusesWordsThatAreNoPicture) {
  ImageData data(kId, {});
  const auto why = [&](std::vector<std::uint32_t> words) -> std::string {
    try {
      data.checkData(words);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_EQ(why({2, 2, 1, 0}), "taken");
  EXPECT_NE(why({2, 2}).find("at least"), std::string::npos);
  EXPECT_NE(why({0, 2, 1}).find("sides"), std::string::npos);
  EXPECT_NE(why({4294967295U, 2, 1}).find("sides"), std::string::npos);
  EXPECT_NE(why({2, 2, 4, 0, 0, 0, 0}).find("bytes a pixel"), std::string::npos);
  EXPECT_NE(why({2, 2, 3, 0, 0}).find("expected 6"), std::string::npos);
}

TEST(ImageData, RefusesPicturesOfAnotherSizeThanItsCamera) {
  ImageData data(kId, {}, CameraView(cameraOf(kPerspective), {.z = 0.5}));
  EXPECT_THROW(data.checkData(std::vector<std::uint32_t>{2, 2, 1, 0}), std::invalid_argument);
  std::vector<std::uint32_t> words;
  ImageData::start({640, 480}, PixelFormat::kGrey, words);
  EXPECT_NO_THROW(data.checkData(words));
}

TEST(ImageData, ItsFormatTellsTheSizeThatACalibratedCameraHas) {
  const CameraView camera(cameraOf(kPerspective), {.z = 0.5});
  EXPECT_EQ(ImageData(kId, {}, camera).format().toText(), "image width=640 height=480");
  EXPECT_EQ(ImageData(kId, {}).format().toText(), "image");
}

TEST(ImageData, RoomForPixelsIsWrittenInPlace) {
  std::vector<std::uint32_t> words;
  ImageData::start({3, 1}, PixelFormat::kRgb, words);
  const auto pixels = ImageData::pixelsOf(words);
  ASSERT_EQ(pixels.size(), 9U);
  pixels[8] = 200;
  EXPECT_EQ(words[5], 200U);
}

}  // namespace
}  // namespace ortung
