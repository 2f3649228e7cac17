#pragma once

#include <memory>
#include <string>

#include "EndPointWeigher.hpp"
#include "Expectations.hpp"

namespace ortung {

/// Expectations of a feature that sees points which should lie where points were seen before.
class EndPointExpectations : public Expectations {
 public:
  struct Config {
    double cell = 0.05;     ///< edge of the field's cells [m]
    double margin = 0.1;    ///< greatest distance of points beyond the region's bounds [m]
    double maxRange = 1.0;  ///< greatest range of points [m]
    SensorModel model;      ///< noise of points
  };
  explicit EndPointExpectations(const Config& config)
      : config_(config), tables_(std::make_shared<EndPointTables>()) {}

  void start(const FieldRegion& region, double headingStep) override;
  void finish() override;
  void save(TableWriter& file, const std::string& prefix) const override;
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
            const FieldGrid& grid) override;

 protected:
  /// Learns a point [m, field frame].
  void mark(double x, double y);
  std::shared_ptr<const EndPointTables> tables() const { return tables_; }

 private:
  Config config_;
  std::shared_ptr<EndPointTables> tables_;
  std::shared_ptr<SurfaceField> marked_;  ///< the surfaces of tables_ while they are learned
};

}  // namespace ortung
