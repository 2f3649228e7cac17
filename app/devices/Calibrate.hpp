#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

struct CalibrateLinesArguments {
  std::vector<std::filesystem::path> pictures;
  std::vector<std::filesystem::path> worlds;
  double height = 0.7;  ///< [m]
  double heightShare = 0.15;
  std::filesystem::path out;   ///< file to write; "": stdout
  std::filesystem::path draw;  ///< folder for drawn pictures; "": none
  bool force = false;
  bool progress = false;
};
int runCalibrateLines(const CalibrateLinesArguments& arguments);

struct CalibrateCameraArguments {
  std::vector<std::filesystem::path> pictures;
  std::string board = "9x6";  ///< inner corners
  std::string model = "perspective";
  std::filesystem::path out;  ///< file to write; "": stdout
  bool force = false;
  bool progress = false;
};
int runCalibrateCamera(const CalibrateCameraArguments& arguments);

struct CalibrateColoursArguments {
  std::vector<std::filesystem::path> pictures;
  std::filesystem::path out;   ///< file to write; "": stdout
  std::filesystem::path draw;  ///< folder for drawn pictures; "": none
  bool force = false;
};
int runCalibrateColours(const CalibrateColoursArguments& arguments);

}  // namespace ortung::app
