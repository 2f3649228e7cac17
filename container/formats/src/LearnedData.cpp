#include "ortung/formats/LearnedData.hpp"

#include <utility>

#include "Expectations.hpp"

namespace ortung {

LearnedData::LearnedData(SensorId id, const Pose2& mount,
                         std::unique_ptr<Expectations> expectations)
    : SensorData(std::move(id), mount), expectations_(std::move(expectations)) {}

LearnedData::~LearnedData() = default;

double LearnedData::headingSpacing() const { return expectations_->headingSpacing(); }
double LearnedData::positionSpacing() const { return expectations_->positionSpacing(); }
ExpectationGrain LearnedData::grain() const { return expectations_->grain(); }
std::string LearnedData::learningKey() const { return expectations_->key(); }

std::vector<double> LearnedData::expectation(const Pose2& pose) const {
  return expectations_->at(pose * mount());
}

void LearnedData::startTables(const FieldRegion& region, double headingStep) {
  expectations_->start(region, headingStep);
}

void LearnedData::learn(const Pose2& robotInField) { expectations_->learn(robotInField * mount()); }
void LearnedData::finishTables() { expectations_->finish(); }

void LearnedData::saveTables(TableWriter& file, const std::string& prefix) const {
  expectations_->save(file, prefix);
}

void LearnedData::useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                            const FieldGrid& grid) {
  expectations_->load(file, prefix, grid);
}

std::shared_ptr<const Weigher> LearnedData::makeWeigher() const { return expectations_->weigher(); }

}  // namespace ortung
