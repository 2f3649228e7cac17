#pragma once

#include <filesystem>
#include <memory>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung {

/// A table file, opened once for any number of robots and threads. Immutable.
class ORTUNG_API RobotTables {
 public:
  /// @throws TableError
  explicit RobotTables(const std::filesystem::path& file);

  const TableInfo& info() const { return *info_; }
  /// Returns where the robot can stand.
  std::shared_ptr<const FieldRegion> region() const { return {info_, &info_->region}; }
  /// Gives every localizing feature of a container its tables, and the container what is known of
  /// the field. @throws TableError as loadTables()
  void giveTo(SensorContainer& container) const;

 private:
  std::shared_ptr<const TableFile> file_;
  std::shared_ptr<const TableInfo> info_;
};

}  // namespace ortung
