#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace ortung::app {

/// Arguments of `ortung export images`.
struct ExportImagesArguments {
  std::string source;  ///< source: "sim:FILE?key=value", or a record with pictures
  std::filesystem::path robot;
  std::filesystem::path out;    ///< folder to write
  std::filesystem::path world;  ///< world of a record, for its annotations; "": none
  std::string camera;           ///< camera's model/type/feature; "": all cameras
  double every = 1;             ///< number n: every n-th picture of a camera is written
  double count = 1e9;           ///< greatest number of pictures
  std::optional<double> variation;
  std::optional<std::uint64_t> seed;  ///< seed of the first picture's look; each has the next
  bool anywhere = false;              ///< whether to take pictures at random places
  std::string shard;                  ///< part of the pictures, "I/N"; "": all of them
  std::string job;                    ///< all options on which the pictures depend, as JSON
  bool force = false;
  bool progress = false;
};
int runExportImages(const ExportImagesArguments& arguments);

}  // namespace ortung::app
