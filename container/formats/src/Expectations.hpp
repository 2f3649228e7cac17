#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/ReadingValue.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// What a feature should read at every pose of its sensor (paper, section 5.2). It refers to the
/// feature that owns it, whose newest reading it learns and weighs. Tables that a weigher holds are
/// never changed: learning and loading begin with new ones.
class Expectations {
 public:
  Expectations() = default;
  virtual ~Expectations() = default;
  Expectations(const Expectations&) = delete;
  Expectations& operator=(const Expectations&) = delete;

  // --- as SensorData describes them; poses are those of the sensor in the field frame ---
  virtual std::string key() const = 0;  ///< learningKey()
  virtual double headingSpacing() const = 0;
  virtual double positionSpacing() const { return 0.0; }
  virtual ExpectationGrain grain() const { return ExpectationGrain::kCells; }
  virtual void start(const FieldRegion& region, double headingStep) = 0;
  virtual void learn(const Pose2& sensor) = 0;
  virtual void finish() {}
  virtual void save(TableWriter& file, const std::string& prefix) const = 0;
  virtual void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                    const FieldGrid& grid) = 0;
  virtual std::vector<double> at(const Pose2& sensor) const = 0;  ///< expectation()
  virtual std::shared_ptr<const Weigher> weigher() const = 0;     ///< makeWeigher()
};

}  // namespace ortung
