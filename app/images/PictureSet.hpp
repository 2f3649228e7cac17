#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "Annotations.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung::app {

/// A folder of pictures for others to train on: images/, segmentations/ (PNG of classes), depth/
/// (PNG of 16 bits, millimetres), annotations.yaml, and the calibration of each camera. Not
/// thread-safe.
class PictureSet {
 public:
  /// @throws std::runtime_error if the folder can't be made, or has something in it and @p force is
  ///   not given
  PictureSet(std::filesystem::path folder, bool force);

  /// @param notes its file is named here @param things may be empty, and then so are @p ranges
  void add(PictureNotes notes, const ImageView& image, std::span<const std::uint32_t> things,
           std::span<const float> ranges);
  /// Writes what belongs to all of them.
  void finish();
  std::size_t size() const { return pictures_.size(); }

 private:
  std::filesystem::path folder_;
  std::vector<PictureNotes> pictures_;
  std::vector<std::string> calibrated_;  ///< cameras whose calibration is written
  std::vector<std::uint8_t> classes_;
  std::vector<std::uint16_t> depths_;
};

}  // namespace ortung::app
