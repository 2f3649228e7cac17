#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ImageFeaturesSettings.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/core/Extractor.hpp"
#include "ortung/vision/BlobFinder.hpp"
#include "ortung/vision/FloorScan.hpp"

namespace ortung {

/// Finds lines, balls, bodies and coloured goals in pictures of a calibrated camera, and where they
/// are around the robot: the same for rendered, recorded and real pictures.
class ImageFeaturesExtractor : public Extractor {
 public:
  explicit ImageFeaturesExtractor(const Parameters& p);

  std::vector<std::string> inputs() const override { return {settings_.reads}; }
  void take(std::span<const SensorData* const> inputs) override;
  void extract(const FieldModel& field, std::span<std::optional<Words>> words) override;

 private:
  void prepare();
  Words lines(const ImageView& image);
  Words balls(const ImageView& image) const;
  Words obstacles(const ImageView& image) const;
  Words goals(const ImageView& image) const;
  Words posts(const ImageView& image) const;
  std::optional<Point3> footOf(const ImageView& image, const ColourTable& colours,
                               const Blob& blob) const;
  /// Range and bearing from the robot's origin of a place in the camera's sensor frame.
  PointsData::Point fromRobot(double x, double y) const;

  ImageFeaturesSettings settings_;
  // Of the newest picture.
  ImageSize size_;
  PixelFormat format_ = PixelFormat::kRgb;
  std::vector<std::uint8_t> pixels_;
  std::optional<CameraView> view_;
  Pose2 mount_;
  // Made once for a camera.
  const CameraModel* prepared_ = nullptr;
  std::unique_ptr<FloorScan> floor_;
  std::unique_ptr<ColourTable> colours_;
  std::vector<std::unique_ptr<ColourTable>> goalColours_;
  std::vector<std::unique_ptr<ColourTable>> postColours_;
  int untilColours_ = 0;  ///< pictures until the floor's colour is looked for again
  LineFinder finder_;
  std::vector<std::uint8_t> taken_;  ///< squares of the floor that have a point
};

}  // namespace ortung
