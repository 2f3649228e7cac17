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
#include "ortung/vision/BallFinder.hpp"
#include "ortung/vision/BlobFinder.hpp"
#include "ortung/vision/FloorScan.hpp"

namespace ortung {

/// Finds lines, balls, bodies and coloured goals, and their places relative to the robot, in
/// pictures of a calibrated camera; it treats rendered, recorded and real pictures alike.
class ImageFeaturesExtractor : public Extractor {
 public:
  explicit ImageFeaturesExtractor(const Parameters& p);

  std::vector<std::string> inputs() const override { return {settings_.reads}; }
  void take(std::span<const SensorData* const> inputs) override;
  void extract(const FieldModel& field, std::span<std::optional<Words>> words) override;

 private:
  void prepare();
  Words lines(const ImageView& image);
  Words balls(const ImageView& image);
  Words obstacles(const ImageView& image) const;
  Words goals(const ImageView& image) const;
  Words posts(const ImageView& image) const;
  std::optional<Point3> footOf(const ImageView& image, const ColourTable& colours,
                               const Blob& blob) const;
  /// Returns range and bearing, from the robot's origin, of a place in the camera's sensor frame.
  PointsData::Point fromRobot(double x, double y) const;

  ImageFeaturesSettings settings_;
  // Properties of the newest picture.
  ImageSize size_;
  PixelFormat format_ = PixelFormat::kRgb;
  std::vector<std::uint8_t> pixels_;
  std::optional<CameraView> view_;
  Pose2 mount_;
  // Tables that are made once per camera.
  const CameraModel* prepared_ = nullptr;
  std::unique_ptr<FloorScan> floor_;
  std::unique_ptr<BallFinder> balls_;
  std::unique_ptr<ColourTable> colours_;
  std::vector<std::unique_ptr<ColourTable>> goalColours_;
  std::vector<std::unique_ptr<ColourTable>> postColours_;
  int untilColours_ = 0;  ///< pictures until the floor's colour is estimated again
  LineFinder finder_;
  std::vector<std::uint8_t> taken_;  ///< whether each square of the floor has a point
};

}  // namespace ortung
