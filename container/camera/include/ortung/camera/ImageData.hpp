#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// How a pixel is stored; the number is its bytes.
enum class PixelFormat : std::uint32_t {
  kGrey = 1,  ///< one byte: brightness
  kRgb = 3,   ///< three bytes: red, green, blue
};

/// A picture whose pixels the caller owns.
struct ImageView {
  ImageSize size;
  PixelFormat format = PixelFormat::kRgb;
  const std::uint8_t* pixels = nullptr;  ///< row by row from the top, without gaps

  int channels() const { return static_cast<int>(format); }
  std::size_t bytes() const {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
           static_cast<std::size_t>(channels());
  }
};

/// Pictures of a camera, with its calibration. Words: width, height, bytes a pixel (1 grey, 3 red,
/// green, blue), then the pixels row by row, four bytes a word, the first the lowest; the last word
/// is filled with 0. So on most machines the words hold the picture as it lies in memory.
/// It says nothing about the pose: extractors make features of it that do. Not thread-safe, see
/// SensorData.
class ORTUNG_API ImageData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kImage;
  static constexpr std::size_t kHeaderWords = 3;
  static constexpr int kMostSide = 4096;  ///< greatest width and height [px]
  using Reading = ImageView;

  /// @param camera the calibration: only pictures of its size are taken. Without one, the camera is
  ///   not calibrated and any size is taken
  ImageData(SensorId id, const Pose2& mount, std::optional<CameraView> camera = {});
  ~ImageData() override;

  /// Returns the newest picture; its pixels live as long as the words of that reading.
  ImageView reading() const;
  /// Returns the picture in words that a feature of this format has taken; its pixels are theirs.
  static ImageView viewOf(std::span<const std::uint32_t> words);
  const std::optional<CameraView>& camera() const { return camera_; }

  /// Sets @p words to a picture without content; the caller writes its pixels into pixelsOf().
  static void start(ImageSize size, PixelFormat format, std::vector<std::uint32_t>& words);
  /// Returns the bytes of the pixels within words that start() made, row by row.
  static std::span<std::uint8_t> pixelsOf(std::vector<std::uint32_t>& words);
  static std::vector<std::uint32_t> encode(const ImageView& image);

  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;

  std::optional<CameraView> camera_;
};

}  // namespace ortung
