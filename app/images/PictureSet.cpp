#include "PictureSet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "PngFile.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// Colours of the classes in their order: background, field, line, goal, post, ball, robot,
/// obstacle, wall.
constexpr std::array<std::uint8_t, 27> kPalette{0,   0,   0, 30,  120, 40,  255, 255, 255,
                                                255, 220, 0, 255, 0,   255, 255, 120, 0,
                                                220, 0,   0, 140, 90,  50,  90,  90,  140};
constexpr double kFarthest = 65.535;  ///< greatest depth in 16 bits of millimetres [m]

}  // namespace

void makePictureFolder(const fs::path& folder, bool force) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw std::runtime_error(folder.string() + ": is a file, expected a folder");
  if (!force && fs::exists(folder, error) && !fs::is_empty(folder, error))
    throw std::runtime_error(folder.string() +
                             ": is not empty; name an empty or new folder, or use "
                             "--force to overwrite pictures");
  for (const char* part : {"images", "segmentations", "depth"}) {
    fs::create_directories(folder / part, error);
    if (error) throw std::runtime_error((folder / part).string() + ": " + error.message());
  }
}

PictureSet::PictureSet(fs::path folder, bool force) : folder_(std::move(folder)) {
  makePictureFolder(folder_, force);
}

void PictureSet::add(std::size_t number, PictureNotes notes, const ImageView& image,
                     std::span<const std::uint32_t> things, std::span<const float> ranges) {
  notes.file = fmt::format("{:06}.png", number);
  notes.size = image.size;
  writePng(folder_ / "images" / notes.file, image);
  if (!things.empty()) {
    classes_.resize(things.size());
    std::transform(things.begin(), things.end(), classes_.begin(),
                   [](std::uint32_t thing) { return static_cast<std::uint8_t>(thing & 0xFFU); });
    writePng(folder_ / "segmentations" / notes.file, image.size, classes_, kPalette);
    depths_.resize(ranges.size());
    std::transform(ranges.begin(), ranges.end(), depths_.begin(), [](float range) {
      return range < kFarthest ? static_cast<std::uint16_t>(std::lround(1000.0 * range))
                               : std::uint16_t{0};
    });
    writePng(folder_ / "depth" / notes.file, image.size, depths_);
  }
  if (notes.camera != nullptr &&
      std::find(calibrated_.begin(), calibrated_.end(), notes.set) == calibrated_.end()) {
    calibrated_.push_back(notes.set);
    std::string file = notes.set + ".toml";
    std::replace(file.begin(), file.end(), '/', '-');
    writeFile(folder_ / file, toToml(*notes.camera));
  }
  numbers_.push_back(number);
  annotations_.push_back(annotationYaml(notes));
}

void PictureSet::finish() { writeFile(folder_ / kAnnotations, annotationsYaml(annotations_)); }

}  // namespace ortung::app
