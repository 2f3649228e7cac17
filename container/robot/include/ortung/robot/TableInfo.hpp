#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// What a table file says of itself.
struct TableInfo {
  std::string world;  ///< the world's name
  std::string worldFingerprint;
  std::string robot;         ///< the robot's name
  double headingStep = 0.0;  ///< [rad]
  FieldRegion region;
  struct Feature {
    std::string id;      ///< "model/type/feature"
    std::string key;     ///< SensorData::learningKey()
    std::string prefix;  ///< of its arrays' names
  };
  std::vector<Feature> features;
  FieldModel field = {};       ///< what does not move in the world; may be empty
  std::string robotToml = {};  ///< text of the robot file; "" if the tables do not hold it
};

/// Writes all learned features of @p container. Returns how many bytes the file has.
/// @throws TableError
ORTUNG_API std::uintmax_t writeTables(const std::filesystem::path& file,
                                      const SensorContainer& container, const TableInfo& info);

/// Reads and checks what a table file says of itself. @throws TableError
ORTUNG_API TableInfo readTableInfo(const TableFile& file);

/// Gives every localizing feature of @p container its tables, and the container what is known of
/// the field.
/// @throws TableError naming the feature that the file lacks or that was learned for a sensor with
///   other settings, and both settings
ORTUNG_API TableInfo loadTables(const std::shared_ptr<const TableFile>& file,
                                SensorContainer& container);

}  // namespace ortung
