#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

class Expectations;

/// A feature that learns tables: what ScalarData, ScanData, ... have in common. An object of its
/// own holds what the feature should read at every pose, and says how that is learned and how a
/// reading is weighed by it, so that a format may have a choice of them (ScanData::Perception).
/// Not thread-safe, see SensorData.
class ORTUNG_API LearnedData : public SensorData {
 public:
  ~LearnedData() override;
  bool localizes() const override { return true; }
  double headingSpacing() const override;
  double positionSpacing() const override;
  std::vector<double> expectation(const Pose2& pose) const override;
  ExpectationGrain grain() const override;
  std::string learningKey() const override;
  void saveTables(TableWriter& file, const std::string& prefix) const override;

 protected:
  LearnedData(SensorId id, const Pose2& mount, std::unique_ptr<Expectations> expectations);
  const Expectations& expectations() const { return *expectations_; }

 private:
  void startTables(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& robotInField) override;
  void finishTables() override;
  void useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                 const FieldGrid& grid) override;
  std::shared_ptr<const Weigher> makeWeigher() const override;

  std::unique_ptr<Expectations> expectations_;
};

}  // namespace ortung
