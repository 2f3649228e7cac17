#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "Annotations.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung::app {

/// A data set of pictures for training: a folder with images/, segmentations/ (PNG of classes),
/// depth/ (PNG of 16 bits, millimetres), annotations.yaml, and the calibration of each camera. Not
/// thread-safe.
class PictureSet {
 public:
  /// @throws std::runtime_error if the folder can't be made, or is not empty and @p force is false
  PictureSet(std::filesystem::path folder, bool force);

  /// Adds a picture.
  /// @param number its number in the data set, which names its files; numbers rise
  /// @param notes its description, except for the file, which is named here
  /// @param things thing of each pixel; may be empty, as may @p ranges then
  /// @param ranges distance along each pixel's ray [m]
  void add(std::size_t number, PictureNotes notes, const ImageView& image,
           std::span<const std::uint32_t> things, std::span<const float> ranges);
  /// Writes the files that describe all pictures.
  void finish();
  const std::vector<std::size_t>& numbers() const { return numbers_; }
  /// Returns the annotationYaml() of the pictures.
  const std::vector<std::string>& annotations() const { return annotations_; }

 private:
  std::filesystem::path folder_;
  std::vector<std::size_t> numbers_;
  std::vector<std::string> annotations_;
  std::vector<std::string> calibrated_;  ///< cameras whose calibration is written
  std::vector<std::uint8_t> classes_;
  std::vector<std::uint16_t> depths_;
};

/// Makes the folder of a data set with the folders in it.
/// @throws std::runtime_error if that can't be made, or is not empty and @p force is false
void makePictureFolder(const std::filesystem::path& folder, bool force);

/// Name of the file that describes all pictures of a data set.
inline constexpr const char* kAnnotations = "annotations.yaml";

}  // namespace ortung::app
