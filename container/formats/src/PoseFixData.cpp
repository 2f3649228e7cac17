#include "ortung/formats/PoseFixData.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "FixWords.hpp"
#include "FormatTools.hpp"
#include "TableSlope.hpp"
#include "ortung/core/Polishable.hpp"

namespace ortung {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Returns the inverse of a covariance to which independent errors were added. Impossible
/// correlations are left out.
Matrix3 informationOf(const PoseFixData::Fix& fix, const PoseFixData::Config& config) {
  const Eigen::Vector3d added(config.addedSigma * config.addedSigma,
                              config.addedSigma * config.addedSigma,
                              config.addedHeadingSigma * config.addedHeadingSigma);
  Matrix3 covariance = Eigen::Map<const Matrix3>(fix.covariance.data());
  covariance.diagonal() += added;
  const double plane = covariance.topLeftCorner<2, 2>().determinant();
  const double all = covariance.determinant();
  const double independent = covariance.diagonal().prod();
  constexpr double kSingular = 1e-6;
  if (!(plane > kSingular * covariance(0, 0) * covariance(1, 1)) ||
      !(all > kSingular * independent))
    covariance = Matrix3(covariance.diagonal().asDiagonal());
  return covariance.inverse();
}

/// A fix and the inverse of its covariance.
struct Weighed {
  Weighed(const Pose2& place, const Matrix3& inverse) : pose(place) {
    Eigen::Map<Matrix3>(information.data()) = inverse;
  }
  Pose2 pose;
  std::array<double, 9> information{};

  /// Distance in standard deviations (Mahalanobis).
  double sigmas(double x, double y, double theta) const {
    const double dx = x - pose.x;
    const double dy = y - pose.y;
    const double dt = wrapAngle(theta - pose.theta);
    const auto& i = information;
    const double squared = i[0] * dx * dx + i[4] * dy * dy + i[8] * dt * dt +
                           2.0 * (i[1] * dx * dy + i[2] * dx * dt + i[5] * dy * dt);
    return std::sqrt(std::max(squared, 0.0));
  }
};

class PoseFixWeigher final : public Weigher, public Polishable {
 public:
  PoseFixWeigher(const PoseFixData::Reading& fixes, const PoseFixData::Config& config,
                 std::shared_ptr<const GaussianTable> gaussian, const FieldGrid& grid)
      : model_(config.model), gaussian_(std::move(gaussian)), grid_(grid) {
    for (const PoseFixData::Fix& fix : fixes)
      fixes_.emplace_back(fix.pose, informationOf(fix, config));
  }

  /// Returns the slope of the nearest fix.
  Slope slopeAt(const Pose2& pose) const override {
    const auto sigmasTo = [&](const Weighed& fix) {
      return fix.sigmas(pose.x, pose.y, pose.theta);
    };
    const auto nearest = std::min_element(
        fixes_.begin(), fixes_.end(),
        [&](const Weighed& a, const Weighed& b) { return sigmasTo(a) < sigmasTo(b); });
    const Matrix3 information = inlierShare(model_.outliers, sigmasTo(*nearest)) * model_.exponent *
                                Eigen::Map<const Matrix3>(nearest->information.data());
    const Eigen::Vector3d off(nearest->pose.x - pose.x, nearest->pose.y - pose.y,
                              wrapAngle(nearest->pose.theta - pose.theta));
    Slope slope;
    Eigen::Map<Matrix3>(slope.information.data()) = information;
    Eigen::Map<Eigen::Vector3d>(slope.pull.data()) = information * off;
    return slope;
  }

 private:
  double logProbabilityAt(const Pose2& pose) const override {
    if (grid_.cellAt(pose.x, pose.y) < 0) return std::numeric_limits<double>::quiet_NaN();
    return Weigher::logProbabilityAt(pose);
  }

  void weigh(const SampleView& poses, std::span<float> logProbability) const override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Weighed& fix : fixes_)
        nearest = std::min(
            nearest, fix.sigmas(static_cast<double>(poses.x[i]), static_cast<double>(poses.y[i]),
                                static_cast<double>(poses.theta[i])));
      logProbability[i] += (*gaussian_)(static_cast<float>(nearest));
    }
  }

  std::vector<Weighed> fixes_;
  SensorModel model_;
  std::shared_ptr<const GaussianTable> gaussian_;
  FieldGrid grid_;
};

}  // namespace

PoseFixData::PoseFixData(SensorId id, const Config& config)
    : SensorData(std::move(id)),
      config_(config),
      gaussian_(std::make_shared<GaussianTable>(config.model)) {
  if (!(config.addedSigma > 0.0) || !(config.addedHeadingSigma > 0.0))
    throw std::invalid_argument("the sigmas that are added to a fix must be positive");
}

PoseFixData::~PoseFixData() = default;

std::vector<std::uint32_t> PoseFixData::encode(std::span<const Fix> fixes) {
  std::vector<std::uint32_t> out;
  for (const Fix& fix : fixes) addFixWords(fix, out);
  return out;
}

void PoseFixData::check(std::span<const std::uint32_t> words) const {
  checkEntries(words, kWordsAFix, kMostFixes, "nine a pose and at most 64 poses");
  for (std::size_t i = 0; i < words.size(); i += kWordsAFix)
    checkFixWords(words.subspan(i, kWordsAFix));
}

void PoseFixData::decode(std::span<const std::uint32_t> words) {
  reading_.clear();
  for (std::size_t i = 0; i < words.size(); i += kWordsAFix) {
    reading_.push_back(fixIn(words.subspan(i, kWordsAFix)));
  }
}

Format PoseFixData::format() const { return Format(kFormat); }

std::string PoseFixData::wordsHelp() const {
  return "[x mm + 2^31, y mm + 2^31, heading 1/100 degree + 18000, sigma x um, sigma y um, sigma "
         "heading 1/10000 degree, correlations xy, x-heading, y-heading 1/10000 + 10000] a pose, "
         "or none: looked and saw nothing";
}

const PoseFixData::Fix* PoseFixData::nearestTo(const Pose2& pose) const {
  const Fix* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Fix& fix : reading_) {
    const double sigmas =
        Weighed(fix.pose, informationOf(fix, config_)).sigmas(pose.x, pose.y, pose.theta);
    if (!(sigmas < least)) continue;
    least = sigmas;
    nearest = &fix;
  }
  return nearest;
}

std::vector<double> PoseFixData::expectation(const Pose2& pose) const {
  return {pose.x, pose.y, pose.theta};
}

std::vector<double> PoseFixData::measured(const Pose2& pose) const {
  const Fix* fix = nearestTo(pose);
  if (fix == nullptr) return {};
  return {fix->pose.x, fix->pose.y, fix->pose.theta};
}

std::vector<double> PoseFixData::covariance(const Pose2& pose) const {
  const Fix* fix = nearestTo(pose);
  if (fix == nullptr) return {};
  return {fix->covariance.begin(), fix->covariance.end()};
}

void PoseFixData::startTables(const FieldRegion& region, double) { grid_ = region.grid; }
void PoseFixData::useTables(const std::shared_ptr<const TableFile>&, const std::string&,
                            const FieldGrid& grid) {
  grid_ = grid;
}

std::shared_ptr<const Weigher> PoseFixData::makeWeigher() const {
  if (reading_.empty()) return nullptr;
  return std::make_shared<PoseFixWeigher>(reading_, config_, gaussian_, grid_);
}

}  // namespace ortung
