#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung calibrate lines`.
struct CalibrateLinesArguments {
  std::vector<std::filesystem::path> pictures;
  std::vector<std::filesystem::path> worlds;
  double height = 0.7;                      ///< height of the camera above the floor [m]
  double heightShare = 0.15;                ///< standard deviation of the height / the height
  std::vector<std::filesystem::path> like;  ///< calibrations of other cameras of this kind
  std::filesystem::path out;                ///< file to write; "": stdout
  std::filesystem::path draw;               ///< folder for drawn pictures; "": none
  bool force = false;
  bool progress = false;
};
int runCalibrateLines(const CalibrateLinesArguments& arguments);

/// Arguments of `ortung calibrate stand`.
struct CalibrateStandArguments {
  std::filesystem::path stands;  ///< TOML file with the pictures and what is known of each
  std::filesystem::path world;
  double height = 0.7;         ///< height of the camera above the floor [m]
  double heightShare = 0.1;    ///< standard deviation of the height / the height
  double focal = 0.0;          ///< focal length [px]; 0: unknown
  bool plain = false;          ///< whether the lens keeps straight lines straight
  double ahead = 0.0;          ///< how far the camera is ahead of the robot's place [m]
  std::filesystem::path out;   ///< file to write; "": stdout
  std::filesystem::path draw;  ///< folder for drawn pictures; "": none
  bool force = false;
};
int runCalibrateStand(const CalibrateStandArguments& arguments);

/// Arguments of `ortung calibrate camera`.
struct CalibrateCameraArguments {
  std::vector<std::filesystem::path> pictures;
  std::string board = "9x6";  ///< numbers of inner corners
  std::string model = "perspective";
  std::filesystem::path out;  ///< file to write; "": stdout
  bool force = false;
  bool progress = false;
};
int runCalibrateCamera(const CalibrateCameraArguments& arguments);

/// Arguments of `ortung calibrate colours`.
struct CalibrateColoursArguments {
  std::vector<std::filesystem::path> pictures;
  std::filesystem::path out;   ///< file to write; "": stdout
  std::filesystem::path draw;  ///< folder for drawn pictures; "": none
  bool force = false;
};
int runCalibrateColours(const CalibrateColoursArguments& arguments);

}  // namespace ortung::app
