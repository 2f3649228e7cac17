#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cstdlib>
#include <opencv2/videoio.hpp>

#include "Await.hpp"
#include "Files.hpp"
#include "ortung/base/Statistics.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/devices/DevicesSource.hpp"

namespace ortung {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr std::array<std::array<int, 3>, 5> kColours{{{200, 30, 30},
                                                      {30, 200, 30},
                                                      {30, 30, 200},
                                                      {200, 200, 30},
                                                      {90, 90, 90}}};  // red, green, blue

/// A video with one colour after the other, ten pictures a second.
void writeVideo(const std::filesystem::path& file) {
  cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0, {kWidth, kHeight});
  ASSERT_TRUE(writer.isOpened());
  for (const auto& [red, green, blue] : kColours)
    writer.write(cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(blue, green, red)));
}

std::string robot(const std::filesystem::path& video, const std::string& size) {
  return "[[sensor]]\nplugin = 'camera'\n"
         "camera = { model = 'perspective', size_px = " +
         size +
         ", focal_px = [60, 60] }\n"
         "device = { plugin = 'camera', port = '" +
         video.string() + "', repeat = true, late_after_s = 60 }\n";
}

/// The usual time [s] between pictures that follow one another in a video that is repeated. The
/// file's clock is exact and ours is put onto it, but a busy computer delays single pictures.
double usualPeriod(const std::vector<Timestamp>& stamps) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    if (i % kColours.size() != 0) periods.push_back(toSeconds(stamps[i] - stamps[i - 1]));
  return quantile(periods, 0.5);
}

/// Until the device is in a state, in which it has given no picture.
void awaitState(DevicesSource& devices, DeviceState state) {
  EXPECT_TRUE(test::comesTrue("the camera is " + std::string(toText(state)), [&] {
    EXPECT_FALSE(devices.poll(std::chrono::milliseconds(50)));
    return devices.status()[0].state == state;
  }));
}

TEST(CameraDevice, PlaysAVideoFileAtItsOwnSpeed) {
  const test::TemporaryFolder folder;
  writeVideo(folder / "clip.avi");
  test::writeBytes(folder / "robot.toml", robot(folder / "clip.avi", "[64, 48]"));
  DevicesSource devices({folder / "robot.toml"});
  std::vector<Message> messages;
  while (messages.size() < 2 * kColours.size()) {
    Message message;
    ASSERT_TRUE(devices.next(message));
    messages.push_back(message);
  }
  std::vector<Timestamp> stamps;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    stamps.push_back(messages[i].stamp);
    ImageData image(messages[i].id, {});
    image.setData(messages[i].stamp, messages[i].words);
    const ImageView view = image.reading();
    ASSERT_EQ(view.size.width, kWidth);
    ASSERT_EQ(view.size.height, kHeight);
    const std::uint8_t* const middle = view.pixels + 3 * (kWidth * kHeight / 2 + kWidth / 2);
    for (std::size_t c = 0; c < 3; ++c)  // JPEG and its colour space round
      EXPECT_NEAR(middle[c], kColours[i % kColours.size()][c], 6) << i << " " << c;
  }
  EXPECT_NEAR(usualPeriod(stamps), 0.1, 0.03);
}

// A file of nothing but pictures one after the other, which tells no times: 25 a second are
// assumed.
TEST(CameraDevice, PlaysPicturesWithoutTimes) {
  const test::TemporaryFolder folder;
  writeVideo(folder / "clip.avi");
  const std::string video = test::readBytes(folder / "clip.avi");
  std::string pictures;
  for (std::size_t at = 0; (at = video.find("\xff\xd8\xff", at)) != std::string::npos; ++at)
    pictures += video.substr(at, video.find("\xff\xd9", at) + 2 - at);
  test::writeBytes(folder / "clip.mjpeg", pictures);
  test::writeBytes(folder / "robot.toml", robot(folder / "clip.mjpeg", "[64, 48]"));
  DevicesSource devices({folder / "robot.toml"});
  std::vector<Timestamp> stamps;
  EXPECT_TRUE(test::comesTrue("all its pictures are there", [&] {
    if (const auto message = devices.poll(std::chrono::milliseconds(50)))
      stamps.push_back(message->stamp);
    return stamps.size() == 3 * kColours.size();  // it is repeated, too
  }));
  EXPECT_NEAR(usualPeriod(stamps), 0.04, 0.015);
}

TEST(CameraDevice, OfAnotherSizeThanItsCalibrationIsAMisfit) {
  const test::TemporaryFolder folder;
  writeVideo(folder / "clip.avi");
  test::writeBytes(folder / "robot.toml", robot(folder / "clip.avi", "[640, 480]"));
  DevicesSource devices({folder / "robot.toml"});
  awaitState(devices, DeviceState::kFailed);
  EXPECT_NE(devices.status()[0].reason.find("gives pictures of 64 x 48"), std::string::npos)
      << devices.status()[0].reason;
}

// It would be waited for until somebody writes into it.
TEST(CameraDevice, ThatIsAPipeIsAMisfit) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  test::writeBytes(folder / "robot.toml", robot(folder / "fifo", "[64, 48]"));
  DevicesSource devices({folder / "robot.toml"});
  awaitState(devices, DeviceState::kFailed);
  EXPECT_NE(devices.status()[0].reason.find("fifo: is no regular file, expected a video"),
            std::string::npos)
      << devices.status()[0].reason;
}

TEST(CameraDevice, OfPicturesThatAreTooLargeIsAMisfit) {
  const test::TemporaryFolder folder;
  {
    cv::VideoWriter writer((folder / "clip.avi").string(), cv::CAP_OPENCV_MJPEG,
                           cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0, {4112, 16});
    ASSERT_TRUE(writer.isOpened());
    writer.write(cv::Mat(16, 4112, CV_8UC3, cv::Scalar(1, 2, 3)));
  }
  test::writeBytes(folder / "robot.toml", robot(folder / "clip.avi", "[64, 48]"));
  DevicesSource devices({folder / "robot.toml"});
  awaitState(devices, DeviceState::kFailed);
  EXPECT_NE(devices.status()[0].reason.find("has pictures of 4112 x 16, expected up to 4096"),
            std::string::npos)
      << devices.status()[0].reason;
}

TEST(CameraDevice, ThatIsNotThereIsAbsent) {
  const test::TemporaryFolder folder;
  test::writeBytes(folder / "robot.toml", robot(folder / "none.avi", "[64, 48]"));
  DevicesSource devices({folder / "robot.toml"});
  awaitState(devices, DeviceState::kAbsent);
  EXPECT_NE(devices.status()[0].reason.find("none.avi"), std::string::npos);
}

}  // namespace
}  // namespace ortung
