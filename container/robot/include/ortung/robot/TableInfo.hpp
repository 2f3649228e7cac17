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

/// The description that a table file has of itself.
struct TableInfo {
  std::string world;             ///< the world's name
  std::string worldFingerprint;  ///< digest of the world's content
  std::string robot;             ///< the robot's name
  double headingStep = 0.0;      ///< step between the directions of its tables [rad]
  FieldRegion region;            ///< cells that were learned
  /// A feature with tables.
  struct Feature {
    std::string id;      ///< "model/type/feature"
    std::string key;     ///< SensorData::learningKey()
    std::string prefix;  ///< begin of its arrays' names
  };
  std::vector<Feature> features;
  FieldModel field = {};       ///< static parts of the world; may be empty
  std::string robotToml = {};  ///< text of the robot file; "" if the tables do not hold it
};

/// Writes all learned features of @p container. Returns how many bytes the file has.
/// @throws TableError
ORTUNG_API std::uintmax_t writeTables(const std::filesystem::path& file,
                                      const SensorContainer& container, const TableInfo& info);

/// Reads and checks the description in a table file. @throws TableError
ORTUNG_API TableInfo readTableInfo(const TableFile& file);

/// Gives every localizing feature of @p container its tables, and the container what is known of
/// the field.
/// @throws TableError naming the feature that the file lacks or that was learned for a sensor with
///   other settings, and both settings
ORTUNG_API TableInfo loadTables(const std::shared_ptr<const TableFile>& file,
                                SensorContainer& container);

}  // namespace ortung
