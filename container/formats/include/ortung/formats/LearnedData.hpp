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
  double headingSpacing() const final;
  double positionSpacing() const final;
  std::vector<double> expectation(const Pose2& pose) const final;
  ExpectationGrain grain() const final;
  std::string learningKey() const final;
  void saveTables(TableWriter& file, const std::string& prefix) const final;

 protected:
  LearnedData(SensorId id, const Pose2& mount, std::unique_ptr<Expectations> expectations);
  const Expectations& expectations() const { return *expectations_; }

 private:
  void startTables(const FieldRegion& region, double headingStep) final;
  void learn(const Pose2& robotInField) final;
  void finishTables() final;
  void useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                 const FieldGrid& grid) final;
  std::shared_ptr<const Weigher> makeWeigher() const final;

  std::unique_ptr<Expectations> expectations_;
};

}  // namespace ortung
