#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung::app {

/// An object that a picture shows.
struct Annotation {
  std::string type;          ///< kind: "ball", "robot", "goalpost", "top_bar" or "obstacle"
  bool isSeen = false;       ///< whether any of its pixels are seen
  bool isConcealed = false;  ///< whether a quarter of its box or more is hidden
  int left = 0, top = 0, right = 0, bottom = 0;  ///< box of its visible part [px]
  Pose2 pose;                                    ///< its pose in the field frame
  double z = 0.0;                                ///< height of its middle [m]
};

/// Makes the annotations of a picture.
/// @param things thing of each pixel, as Traced::things
/// @param sensor pose of the camera's sensor frame in the field frame
std::vector<Annotation> annotationsOf(std::span<const std::uint32_t> things, const World& world,
                                      const CameraView& camera, const Pose2& sensor);

/// Description of a picture.
struct PictureNotes {
  std::string file;  ///< name of its file
  ImageSize size;    ///< its size [px]
  std::vector<Annotation> annotations;
  std::optional<Pose2> sensor;  ///< pose of the camera's sensor frame in the field frame
  const CameraView* camera = nullptr;
  std::string location;  ///< the world's name, or ""
  std::string tag;       ///< origin of the picture
  std::string set;       ///< camera that took it
};

/// Returns the YAML of a picture, an entry of a data set's: with the keys of the TORSO-21 data set
/// (Bestmann et al., "TORSO-21 Dataset: Typical Objects in RoboCup Soccer 2021").
std::string annotationYaml(const PictureNotes& picture);

/// Returns the YAML of a data set of pictures. @param pictures their annotationYaml()
std::string annotationsYaml(std::span<const std::string> pictures);

}  // namespace ortung::app
