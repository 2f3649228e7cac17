#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace ortung::app {

struct ExportImagesArguments {
  std::string source;  ///< "sim:FILE?key=value", or a record with pictures
  std::filesystem::path robot;
  std::filesystem::path out;    ///< folder
  std::filesystem::path world;  ///< of a record, for what its pictures show; "" for none
  std::string camera;           ///< model/type/feature; "": all
  double every = 1;             ///< picture of each camera
  double count = 1e9;           ///< pictures at most
  std::optional<double> variation;
  std::optional<std::uint64_t> seed;  ///< of the first picture's look; each has the next one
  bool anywhere = false;              ///< from places at random
  bool force = false;
  bool progress = false;
};
int runExportImages(const ExportImagesArguments& arguments);

}  // namespace ortung::app
