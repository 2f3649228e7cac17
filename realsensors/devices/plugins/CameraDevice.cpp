#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "ortung/camera/ImageData.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/devices/DeviceDriver.hpp"
#include "ortung/devices/Port.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::string_view kVideo = "/dev/video";
constexpr double kMostRate = 1000.0;  ///< greatest rate of pictures [Hz]
constexpr double kLatestTime = 1e12;  ///< of a picture [ms]: 31 years; cameras count from the boot

/// A camera that OpenCV reads ("/dev/video0"), or a video file, which is played at its own speed.
/// Pictures that nobody has taken in time are passed over by the system, the newest one counts.
class CameraDevice : public DeviceDriver {
 public:
  explicit CameraDevice(const Parameters& p)
      : name_(p.text("port")),
        width_(static_cast<int>(p.integerOr("width_px", 0, {0, ImageData::kMostSide}))),
        height_(static_cast<int>(p.integerOr("height_px", 0, {0, ImageData::kMostSide}))),
        rate_(p.numberOr("rate_hz", 0.0, {0.0, kMostRate})),
        isGrey_(p.choiceOr("pixels", "rgb", {"rgb", "grey"}) == "grey"),
        repeats_(p.flagOr("repeat", false)) {}

  void serve(std::span<const SensorData* const> features) override {
    if (features.size() != 1 || !isOf(*features.front(), formats::kImage))
      throw std::invalid_argument("a camera fills one feature of pictures and nothing else");
    feature_ = features.front();
  }

  void open() override {
    if (isAtEnd_) throw DeviceAbsent(name_ + ": has come to its end");
    isFile_ = name_.find(kVideo) == std::string::npos;
    if (isFile_) checkFile();
    // The back ends would print, and look for the file on the network or as numbered pictures.
    const bool isOpen = video_.open(name_, isFile_ ? cv::CAP_FFMPEG : cv::CAP_V4L2);
    if (!isOpen) throw DeviceAbsent(name_ + ": can't be opened as a camera or a video");
    if (isFile_) checkSize();
    if (width_ > 0) video_.set(cv::CAP_PROP_FRAME_WIDTH, width_);
    if (height_ > 0) video_.set(cv::CAP_PROP_FRAME_HEIGHT, height_);
    if (rate_ > 0.0 && !isFile_) video_.set(cv::CAP_PROP_FPS, rate_);
    played_ = Clock::now();
    laps_ = 0.0;
    last_ = -1.0;
    isFirst_ = true;
  }

  void read(std::chrono::milliseconds patience, std::vector<DeviceReading>& readings) override {
    if (isAtEnd_) {
      std::this_thread::sleep_for(patience);
      return;
    }
    if (!pending_ && !grab()) return;
    if (isFile_ && !isDue(patience)) return;
    pending_ = false;
    cv::Mat picture;
    if (!video_.retrieve(picture) || picture.empty()) {
      ++refused_;
      return;
    }
    DeviceReading reading;
    reading.deviceTime = static_cast<Timestamp>(std::llround(1000.0 * (time_ + laps_)));
    encode(picture, reading.words);
    checkFits(reading.words, picture);
    isFirst_ = false;
    readings.push_back(std::move(reading));
  }

  void close() noexcept override {
    try {
      video_.release();
    } catch (const std::exception&) {
      // A release that is refused: it is closed all the same.
    }
    pending_ = false;
  }
  std::uint64_t refused() const override { return refused_; }

 private:
  /// A pipe or a folder under a video's name would be waited for, or be searched.
  void checkFile() const {
    std::error_code error;
    const auto kind = std::filesystem::status(name_, error).type();
    if (kind != std::filesystem::file_type::regular &&
        kind != std::filesystem::file_type::not_found)
      throw DeviceMisfit(name_ +
                         ": is no regular file, expected a video or a camera (/dev/video*)");
  }

  /// Before anything is decoded, by what the file says.
  void checkSize() const {
    const double width = video_.get(cv::CAP_PROP_FRAME_WIDTH);
    const double height = video_.get(cv::CAP_PROP_FRAME_HEIGHT);
    if (std::max(width, height) > ImageData::kMostSide)
      throw DeviceMisfit(name_ + ": has pictures of " + std::to_string(std::llround(width)) +
                         " x " + std::to_string(std::llround(height)) + ", expected up to " +
                         std::to_string(ImageData::kMostSide) + " a side");
  }

  /// Takes the next picture; of a file also its time. False at the end.
  bool grab() {
    if (!video_.grab()) {
      if (!isFile_) throw DeviceAbsent(name_ + ": gives no picture any more");
      if (isFirst_ || last_ < 0.0) throw DeviceMisfit(name_ + ": holds no picture");
      if (!repeats_) {
        isAtEnd_ = true;
        return false;
      }
      laps_ += std::max(last_, 0.0) + 40.0;
      // Not all files can be wound back.
      if (!video_.open(name_, cv::CAP_FFMPEG))
        throw DeviceAbsent(name_ + ": can't be opened again to repeat it");
      last_ = -1.0;
      return false;
    }
    const double time = video_.get(cv::CAP_PROP_POS_MSEC);
    const double rate = video_.get(cv::CAP_PROP_FPS);
    // Of files without times, the rate may be the ticks of a clock.
    const double step = rate > 1.0 && rate <= kMostRate ? 1000.0 / rate : 40.0;
    // Some files tell no times, or one that no clock will show.
    time_ = time > last_ && time < kLatestTime ? time : last_ + step;
    last_ = time_;
    pending_ = true;
    return true;
  }

  /// Whether the time of a file's picture has come, having waited for it until patience is over.
  bool isDue(std::chrono::milliseconds patience) const {
    const auto due = played_ + std::chrono::microseconds(std::llround(1000.0 * (time_ + laps_)));
    std::this_thread::sleep_until(std::min(due, Clock::now() + patience));
    return Clock::now() >= due;
  }

  /// Straight into the words: one copy, which turns the colours round.
  void encode(const cv::Mat& picture, std::vector<std::uint32_t>& words) const {
    if (picture.depth() != CV_8U || picture.cols > ImageData::kMostSide ||
        picture.rows > ImageData::kMostSide)
      throw DeviceMisfit(name_ + ": gives pictures of " + std::to_string(picture.cols) + " x " +
                         std::to_string(picture.rows) + " that are no bytes or too large");
    const bool isColour = !isGrey_ && picture.channels() == 3;
    ImageData::start({picture.cols, picture.rows},
                     isColour ? PixelFormat::kRgb : PixelFormat::kGrey, words);
    cv::Mat out(picture.rows, picture.cols, isColour ? CV_8UC3 : CV_8UC1,
                ImageData::pixelsOf(words).data());
    if (isColour)
      cv::cvtColor(picture, out, cv::COLOR_BGR2RGB);
    else if (picture.channels() == 3)
      cv::cvtColor(picture, out, cv::COLOR_BGR2GRAY);
    else
      picture.copyTo(out);
  }

  /// A calibration belongs to one size.
  void checkFits(const std::vector<std::uint32_t>& words, const cv::Mat& picture) const {
    if (!isFirst_) return;
    try {
      feature_->checkData(words);
    } catch (const std::invalid_argument& error) {
      throw DeviceMisfit(name_ + ": gives pictures of " + std::to_string(picture.cols) + " x " +
                         std::to_string(picture.rows) + ": " + error.what());
    }
  }

  std::string name_;
  int width_;
  int height_;
  double rate_;  ///< [1/s]; 0: as the camera likes
  bool isGrey_;
  bool repeats_;
  const SensorData* feature_ = nullptr;
  cv::VideoCapture video_;
  bool isFile_ = false;
  bool pending_ = false;  ///< a picture was taken and not yet given
  bool isAtEnd_ = false;
  bool isFirst_ = true;
  Clock::time_point played_;
  double time_ = 0.0;   ///< of the picture, by the camera's clock or in the file [ms]
  double last_ = -1.0;  ///< the same of the one before
  double laps_ = 0.0;   ///< of a file that is repeated [ms]
  std::uint64_t refused_ = 0;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("camera_device",
               ortung::provide<ortung::DeviceDriver, ortung::CameraDevice>("camera"));
