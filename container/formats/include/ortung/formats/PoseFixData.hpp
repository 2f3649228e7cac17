#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Absolute poses of the robot in the field, each with its covariance, found by a sensor that knows
/// the field, e.g. a scanner from walls and goals. Where the field looks alike from several places,
/// there are several poses, and one of them is right.
/// Words: nine a pose: x, y [signed mm], [angle], sigma of x, of y [um] and of the heading
/// [1/10000 degree], correlations xy, x-heading, y-heading [1/10000 + 10000]; none: not found.
/// Weighs a pose by its best fix. There is nothing to learn. Not thread-safe, see SensorData.
class ORTUNG_API PoseFixData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kFix;
  struct Config {
    /// Standard deviation of positions that is added to the fix's own [m].
    double addedSigma = 0.05;
    double addedHeadingSigma = 0.03;  ///< standard deviation of headings that is added [rad]
    SensorModel model{};              ///< outliers and exponent; its sigmas are not used
  };
  struct Fix {
    Pose2 pose;                   ///< pose of the robot in the field frame
    PoseCovariance covariance{};  ///< covariance along the axes of the field frame
  };
  using Reading = std::vector<Fix>;
  static constexpr std::size_t kMostFixes = 64;

  PoseFixData(SensorId id, const Config& config);
  ~PoseFixData() override;

  const Reading& reading() const { return reading_; }
  const Config& config() const { return config_; }
  /// Returns the words of fixes. Sigmas are raised to at least 1 um and 1/10000 degree.
  static std::vector<std::uint32_t> encode(std::span<const Fix> fixes);

  Format format() const override;
  std::string wordsHelp() const override;
  bool localizes() const override { return true; }
  double headingSpacing() const override { return 0.0; }
  /// Returns the pose itself.
  std::vector<double> expectation(const Pose2& pose) const override;
  bool isAngle(std::size_t index) const override { return index == 2; }
  /// Returns the fix that is nearest to the pose by its covariance: x, y [m], heading [rad].
  std::vector<double> measured(const Pose2& pose) const override;
  std::vector<double> covariance(const Pose2& pose) const override;
  std::string learningKey() const override { return "fix"; }

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  void startTables(const FieldRegion& region, double headingStep) override;
  void useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                 const FieldGrid& grid) override;
  std::shared_ptr<const Weigher> makeWeigher() const override;
  const Fix* nearestTo(const Pose2& pose) const;

  Config config_;
  std::shared_ptr<const GaussianTable> gaussian_;
  FieldGrid grid_;
  Reading reading_;
};

}  // namespace ortung
