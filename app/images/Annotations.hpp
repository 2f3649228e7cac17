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

/// A thing of which a picture shows something.
struct Annotation {
  std::string type;  ///< "ball", "robot", "goalpost", "top_bar", "obstacle"
  bool isSeen = false;
  bool isConcealed = false;                      ///< something hides a good part of it
  int left = 0, top = 0, right = 0, bottom = 0;  ///< of what is seen of it [pixels]
  Pose2 pose;                                    ///< in the field frame
  double z = 0.0;                                ///< of its middle [m]
};

/// What is annotated of a picture.
/// @param things of its pixels, as Sheet::things @param sensor in the field frame
std::vector<Annotation> annotationsOf(std::span<const std::uint32_t> things, const World& world,
                                      const CameraView& camera, const Pose2& sensor);

/// All that is known of a picture.
struct PictureNotes {
  std::string file;
  ImageSize size;
  std::vector<Annotation> annotations;
  std::optional<Pose2> sensor;  ///< in the field frame
  const CameraView* camera = nullptr;
  std::string location;  ///< the world's name, or ""
  std::string tag;       ///< where the picture is from
  std::string set;       ///< which camera took it
};

/// The YAML of a data set of pictures, with the keys of the TORSO-21 data set (Bestmann et al.,
/// "TORSO-21 Dataset: Typical Objects in RoboCup Soccer 2021").
std::string annotationsYaml(std::span<const PictureNotes> pictures);

}  // namespace ortung::app
