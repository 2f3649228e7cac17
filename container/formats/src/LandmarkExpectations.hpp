#pragma once

#include <memory>
#include <string>
#include <vector>

#include "Expectations.hpp"
#include "LandmarkLevels.hpp"
#include "LandmarkPlaces.hpp"
#include "UnidentifiedSight.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/tables/PositionTable.hpp"

namespace ortung {

/// Range and bearing of each landmark of a list by the sensor's position or, if landmarks can't be
/// told apart, where each of them is.
class LandmarkExpectations final : public Expectations {
 public:
  LandmarkExpectations(const LandmarksData& landmarks, const LandmarksData::Config& config);

  /// Returns the places of landmarks that can't be told apart; else it is empty.
  const LandmarkPlaces& places() const { return *tables_->places; }

  std::string key() const override;
  double headingSpacing() const override;
  void start(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& sensor) override;
  void finish() override;
  void save(TableWriter& file, const std::string& prefix) const override;
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
            const FieldGrid& grid) override;
  std::vector<double> at(const Pose2& sensor) const override;
  std::shared_ptr<const Weigher> weigher() const override;

 private:
  /// Likelihood of residuals, the same for all readings.
  struct Model {
    explicit Model(const LandmarksData::Config& config);
    SensorModel range;
    SensorModel bearing;
    GaussianTable ranges;
    GaussianTable bearings;
    std::shared_ptr<const UnidentifiedSight::Model> unidentified;
  };
  struct Tables {
    struct Landmark {
      PositionTable range;
      BearingTable bearing;
    };
    explicit Tables(const LandmarksData::Config& config);
    /// Tables in the order of the identities; empty if unidentified.
    std::vector<Landmark> landmarks;
    /// The same in the order in which they are looked up, once they are complete.
    LandmarkLevels levels;
    void complete();
    std::shared_ptr<LandmarkPlaces> places = std::make_shared<LandmarkPlaces>();
  };
  class Sight;  ///< the weigher of landmarks that can be told apart

  const LandmarksData& landmarks_;
  std::shared_ptr<const Model> model_;
  std::shared_ptr<Tables> tables_;
};

}  // namespace ortung
