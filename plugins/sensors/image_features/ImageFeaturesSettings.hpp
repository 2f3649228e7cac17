#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "../common/SensorSettings.hpp"
#include "../iconic/IconicSettings.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/vision/Colours.hpp"
#include "ortung/vision/LineFinder.hpp"

namespace ortung {

/// The features that can be found in pictures, by name.
inline const std::vector<std::string> kImageFeatures = {"lines", "ball", "obstacles", "goals",
                                                        "posts"};

/// Settings of all halves of the sensor that finds things in pictures.
struct ImageFeaturesSettings {
  SensorId id;                   ///< its feature is not used
  std::string reads;             ///< the picture feature that is read: "model/type/feature"
  std::vector<std::string> see;  ///< features to find, of kImageFeatures
  /// Whether the floor's colours are estimated from pictures; otherwise they are `colours`.
  bool findsColours = true;
  Colours colours;
  LineFinder::Config finder;
  double pixelSigma = 1.0;   ///< standard deviation of places in the picture [pixels]
  double spacing = 0.1;      ///< width of the squares of the floor with one line point each [m]
  double ballRadius = 0.11;  ///< radius of the ball [m]
  double maxRange = 8.0;     ///< greatest range of balls, obstacles and goals [m]
  PointsData::Config lines;
  LandmarksData::Config goals;
  std::vector<ColourRange> goalColours;  ///< colours of the goals, in the order of identities
  double goalDepth = 0.0;  ///< distance of the coloured wall behind the goal's place [m]
  PointsData::Config posts;
  std::vector<ColourRange> postColours;
  double mostPostWidth = 0.5;  ///< greatest width of posts; wider blobs are ignored [m]
  double period = 0.1;         ///< period of simulated readings [s]; pictures have their own

  bool sees(const std::string& feature) const {
    return std::find(see.begin(), see.end(), feature) != see.end();
  }
};

namespace image_features {

inline std::vector<std::string> readSee(const Parameters& p) {
  if (!p.has("see")) return {"lines"};
  const std::vector<std::string> see = p.texts("see");
  if (see.empty()) p.fail("see", "is empty, expected features to find");
  for (std::size_t i = 0; i < see.size(); ++i) {
    if (std::find(kImageFeatures.begin(), kImageFeatures.end(), see[i]) == kImageFeatures.end())
      p.fail("see", "has \"" + see[i] + "\", expected lines, ball, obstacles, goals or posts");
    if (std::find(see.begin(), see.begin() + static_cast<std::ptrdiff_t>(i), see[i]) !=
        see.begin() + static_cast<std::ptrdiff_t>(i))
      p.fail("see", "has \"" + see[i] + "\" twice");
  }
  return see;
}

inline void readLines(const Parameters& p, ImageFeaturesSettings& s) {
  s.finder.spacing = static_cast<int>(p.integerOr("spacing_px", s.finder.spacing, {1, 100}));
  s.finder.minContrast = p.numberOr("min_contrast", s.finder.minContrast, {0.0, 10.0});
  s.finder.minStep = static_cast<int>(p.integerOr("min_step", s.finder.minStep, {1, 200}));
  s.pixelSigma = p.numberOr("pixel_sigma_px", s.pixelSigma, {0.01, 100.0});
  s.spacing = p.numberOr("spacing_m", s.spacing, {0.01, 2.0});
  PointsData::Config& c = s.lines;
  c.maxRange = p.numberOr("max_range_m", 6.0, {0.05, 1000.0});
  c.cell = p.numberOr("cell_m", c.cell, {0.005, 1.0});
  c.usedPoints = static_cast<int>(p.integerOr("used_points", 0, {0, 4096}));
  c.model = SensorModel::read(p, "sigma_m", c.model);
}

inline ColourRange readColour(const Parameters& p) {
  ColourRange range;
  range.hue = p.number("hue_deg", {0.0, 360.0});
  range.hueTolerance = p.numberOr("hue_tolerance_deg", 20.0, {0.0, 180.0});
  range.minSaturation = p.numberOr("min_saturation", 0.35, {0.0, 1.0});
  range.minValue = p.numberOr("min_value", 0.15, {0.0, 1.0});
  range.maxValue = p.numberOr("max_value", 1.0, {0.0, 1.0});
  return range;
}

/// Reads the colours that distinguish goals: a table each, in the order of identities.
inline void readGoals(const Parameters& p, ImageFeaturesSettings& s) {
  for (const Parameters& goal : p.tables("colour")) {
    s.goals.identities.push_back(static_cast<std::uint32_t>(goal.integer("identity", {0, 1e6})));
    s.goalColours.push_back(readColour(goal));
  }
  if (s.goalColours.empty())
    p.fail("colour",
           "is missing: goals are told apart by their colours, a table "
           "[[sensor.goals.colour]] with identity and hue_deg each");
  s.goalDepth = p.numberOr("depth_m", 0.0, {0.0, 10.0});
  s.goals.maxRange = s.maxRange;
  s.goals.range = SensorModel::read(p, "range_sigma_m", {.sigma = 0.3, .sigmaPerMetre = 0.1});
  s.goals.bearing = SensorModel::read(p, "bearing_sigma_deg", {.sigma = radians(4.0)});
}

/// Reads the colours of posts, which are not distinguished.
inline void readPosts(const Parameters& p, ImageFeaturesSettings& s) {
  for (const Parameters& colour : p.tables("colour")) s.postColours.push_back(readColour(colour));
  if (s.postColours.empty())
    p.fail("colour",
           "is missing: a table [[sensor.posts.colour]] with hue_deg for each colour of "
           "posts");
  s.mostPostWidth = p.numberOr("most_width_m", s.mostPostWidth, {0.01, 10.0});
  s.posts.maxRange = s.maxRange;
  s.posts.model =
      SensorModel::read(p, "sigma_m", {.sigma = 0.2, .sigmaPerMetre = 0.1, .exponent = 1.0});
}

}  // namespace image_features

/// Reads all settings of all halves. @throws ConfigError
inline ImageFeaturesSettings readImageFeaturesSettings(const Parameters& p) {
  ImageFeaturesSettings s;
  if (p.has("feature")) p.fail("feature", "is given, but the features' names come from see");
  s.id = sensorIdOf(p, {"vision", "camera", "features"});
  s.reads = p.textOr("reads", "*/camera/image");
  if (p.has("reads")) checkQuery(p, "reads");
  s.see = image_features::readSee(p);
  s.findsColours = !p.has("colours");
  s.colours = readColours(p.table("colours"));
  s.maxRange = p.numberOr("max_range_m", s.maxRange, {0.05, 1000.0});
  s.ballRadius = p.numberOr("ball_radius_m", s.ballRadius, {0.01, 1.0});
  s.period = readPeriod(p, 0.1);
  // Tables of features that are not searched stay unread and are reported as unknown keys.
  if (s.sees("lines")) image_features::readLines(p.table("lines"), s);
  if (s.sees("goals")) image_features::readGoals(p.table("goals"), s);
  if (s.sees("posts")) image_features::readPosts(p.table("posts"), s);
  return s;
}

}  // namespace ortung
