#include "ortung/study/NoiseLearner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "ortung/base/Angles.hpp"
#include "ortung/run/ReadingValues.hpp"
#include "ortung/study/Evaluation.hpp"

namespace ortung {
namespace {

constexpr int kLinearizations = 3;
/// Difference of the four cells around a place from which on there is an edge between them [m].
constexpr double kEdge = 0.3;
constexpr double kBesides = 0.5 * kDegree;
// Step sizes of numerical differences.
constexpr double kMetres = 0.1;
constexpr double kRadians = 0.02;
constexpr double kSeconds = 0.05;

/// Returns whether values come in pairs of a range and a bearing.
bool arePairs(const SensorData& feature, std::size_t values) {
  return values > 1 && values % 2 == 0 && !feature.isAngle(0) && feature.isAngle(1) &&
         !(values > 2 && feature.isAngle(2));
}

std::size_t indexOf(NoiseTerm term) { return static_cast<std::size_t>(term); }

/// A feature's expectation, interpolated between cells and directions.
class Expected {
 public:
  Expected(const SensorData& feature, const TableInfo& tables)
      : feature_(feature),
        grid_(tables.region.grid),
        back_(inverse(feature.mount())),
        step_(feature.grain() == ExpectationGrain::kCellsAndDirections ? tables.headingStep : 0.0) {
  }

  /// Returns the expectation with the SENSOR at a pose; NaN if nothing is expected or there is an
  /// edge.
  std::vector<double> at(const Pose2& sensor) const {
    if (feature_.grain() == ExpectationGrain::kExact) return betweenEdges(sensor);
    // A table is constant over a direction's width, so its mean over that width interpolates
    // linearly.
    const std::size_t turns = step_ > 0.0 ? 4 : 1;
    std::vector<double> mean;
    for (std::size_t t = 0; t < turns; ++t) {
      const double share = (static_cast<double>(t) + 0.5) / static_cast<double>(turns) - 0.5;
      const std::vector<double> one =
          betweenCells({sensor.x, sensor.y, wrapAngle(sensor.theta + share * step_)});
      if (t == 0) mean.assign(one.size(), 0.0);
      if (one.size() != mean.size()) return {};
      for (std::size_t i = 0; i < one.size(); ++i) mean[i] += one[i] / static_cast<double>(turns);
    }
    return mean;
  }

 private:
  /// Returns NaN at edges, where beams half a degree to either side hit something else.
  std::vector<double> betweenEdges(const Pose2& sensor) const {
    std::vector<double> middle = feature_.expectation(sensor * back_);
    for (const double turn : {-kBesides, kBesides}) {
      const std::vector<double> other =
          feature_.expectation(sensor * Pose2{0.0, 0.0, turn} * back_);
      if (other.size() != middle.size()) return {};
      for (std::size_t i = 0; i < middle.size(); ++i)
        if (!(std::abs(other[i] - middle[i]) < kEdge))
          middle[i] = std::numeric_limits<double>::quiet_NaN();
    }
    return middle;
  }
  std::vector<double> betweenCells(const Pose2& sensor) const {
    const double column = (sensor.x - grid_.originX) / grid_.cell - 0.5;
    const double row = (sensor.y - grid_.originY) / grid_.cell - 0.5;
    const double right = column - std::floor(column);
    const double up = row - std::floor(row);
    std::vector<double> sum;
    std::vector<double> first;
    std::vector<double> low;
    std::vector<double> high;
    for (int corner = 0; corner < 4; ++corner) {
      const int dx = corner % 2;
      const int dy = corner / 2;
      const Pose2 place{grid_.originX + (std::floor(column) + dx + 0.5) * grid_.cell,
                        grid_.originY + (std::floor(row) + dy + 0.5) * grid_.cell, sensor.theta};
      std::vector<double> one = feature_.expectation(place * back_);
      const double share = (dx == 0 ? 1.0 - right : right) * (dy == 0 ? 1.0 - up : up);
      if (corner == 0) {
        sum.assign(one.size(), 0.0);
        first = low = high = one;
      }
      if (one.size() != sum.size()) return {};
      for (std::size_t i = 0; i < one.size(); ++i) {
        if (feature_.isAngle(i)) one[i] = first[i] + wrapAngle(one[i] - first[i]);
        low[i] = std::min(low[i], one[i]);
        high[i] = std::max(high[i], one[i]);
        sum[i] += share * one[i];
      }
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (!(high[i] - low[i] < kEdge)) sum[i] = std::numeric_limits<double>::quiet_NaN();
    return sum;
  }

  const SensorData& feature_;
  const FieldGrid& grid_;
  Pose2 back_;
  double step_;  ///< angle between directions of its tables [rad]; zero: they have none
};

/// Computes residuals of readings, given what is already known about the device.
class Residuals {
 public:
  Residuals(const TableInfo& tables, std::span<const NoiseLog> logs, const NoiseLearning& how)
      : tables_(tables), logs_(logs), how_(how) {}

  /// @param already known terms, of which mount and latency are applied; biases are not
  std::vector<NoiseResidual> of(std::span<SensorData* const> features,
                                const ByNoiseTerm<double>& already) {
    readings_ = 0;
    residuals_.clear();
    already_ = already;
    std::size_t values = 0;
    for (const SensorData* feature : features)
      for (const NoiseLog& log : logs_) values += valuesOf(*feature, log);
    // If there are too many values, readings are left out first, then beams of the others.
    const auto times = static_cast<double>(values) / static_cast<double>(how_.mostValues);
    everyReading_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(std::sqrt(times))));
    everyValue_ = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(times / static_cast<double>(everyReading_))));
    for (SensorData* feature : features)
      for (std::size_t log = 0; log < logs_.size(); ++log) add(*feature, log);
    return std::move(residuals_);
  }
  std::size_t readings() const { return readings_; }

 private:
  static std::size_t valuesOf(const SensorData& feature, const NoiseLog& log) {
    const auto found = log.readings.find(toText(feature.id()));
    if (found == log.readings.end()) return 0;
    std::size_t words = 0;
    for (const NoiseLog::Reading& reading : found->second) words += reading.words.size();
    return words;
  }

  void add(SensorData& feature, std::size_t log) {
    const auto found = logs_[log].readings.find(toText(feature.id()));
    if (found == logs_[log].readings.end()) return;
    const Expected expected(feature, tables_);
    for (std::size_t i = 0; i < found->second.size(); i += everyReading_) {
      const NoiseLog::Reading& reading = found->second[i];
      feature.setData(reading.stamp, reading.words);
      if (!feature.covariance({}).empty()) continue;  // it reports its own covariance
      addReading(feature, expected, log);
    }
  }

  std::optional<Pose2> sensorAt(std::size_t log, Timestamp stamp, double latency,
                                const Pose2& mount) const {
    const auto robot =
        interpolate(logs_[log].reference, stamp - fromSeconds(latency), how_.longestGap);
    if (!robot) return std::nullopt;
    return *robot * mount;
  }

  Pose2 mountOf(const SensorData& feature) const {
    const Pose2& mount = feature.mount();
    return {mount.x + already_[indexOf(NoiseTerm::kMountX)],
            mount.y + already_[indexOf(NoiseTerm::kMountY)],
            wrapAngle(mount.theta + already_[indexOf(NoiseTerm::kMountTheta)])};
  }

  /// Expectations at sensor poses to either side, for each term but biases, and the poses'
  /// difference.
  struct Sides {
    std::array<std::vector<double>, 4> before;
    std::array<std::vector<double>, 4> after;
    std::array<double, 4> apart{};
  };
  std::optional<Sides> sidesOf(const SensorData& feature, const Expected& expected,
                               std::size_t log) const {
    Sides sides;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!how_.wanted[k + 2]) continue;
      const double step = k < 2 ? kMetres : (k == 2 ? kRadians : kSeconds);
      for (const double way : {-step, step}) {
        Pose2 mount = mountOf(feature);
        double latency = already_[indexOf(NoiseTerm::kLatency)];
        (k == 0 ? mount.x : k == 1 ? mount.y : k == 2 ? mount.theta : latency) += way;
        const auto sensor = sensorAt(log, feature.stamp(), latency, mount);
        if (!sensor) return std::nullopt;
        (way < 0.0 ? sides.before : sides.after)[k] = expected.at(*sensor);
      }
      sides.apart[k] = 2.0 * step;
    }
    return sides;
  }

  void addReading(const SensorData& feature, const Expected& expected, std::size_t log) {
    const double latency = already_[indexOf(NoiseTerm::kLatency)];
    const auto sensor = sensorAt(log, feature.stamp(), latency, mountOf(feature));
    if (!sensor) return;
    const std::vector<double> middle = expected.at(*sensor);
    const auto sides = sidesOf(feature, expected, log);
    if (middle.empty() || !sides) return;
    ++readings_;
    const bool isSighting = arePairs(feature, middle.size());
    const std::size_t every = isSighting ? 1 : everyValue_;  // a pair stays together
    // The measured values do not depend on the pose.
    const std::vector<ReadingValue> values =
        readingValues(feature, *sensor * inverse(feature.mount()));
    for (std::size_t i = 0; i < std::min(values.size(), middle.size()); i += every) {
      if (!values[i].measured || !std::isfinite(*values[i].measured)) continue;
      if (!std::isfinite(middle[i])) continue;
      NoiseResidual residual;
      residual.stamp = feature.stamp();
      residual.log = log;
      residual.isAngle = values[i].isAngle;
      residual.residual = *values[i].measured - middle[i];
      if (residual.isAngle) residual.residual = wrapAngle(residual.residual);
      residual.range = residual.isAngle ? 0.0 : *values[i].measured;
      residual.by[residual.isAngle ? 1 : 0] = 1.0;
      if (isSighting) {
        if (!std::isfinite(middle[i | 1U])) continue;  // too near to have a direction
        addBend(middle, i, residual);
      }
      if (takeSides(*sides, i, residual)) residuals_.push_back(residual);
    }
  }

  /// Adds how a sighting's range and bearing, which come in pairs, depend on range and bearing.
  static void addBend(const std::vector<double>& expected, std::size_t i, NoiseResidual& residual) {
    const double b = expected[i | 1U];
    if (residual.isAngle) {
      residual.by[indexOf(NoiseTerm::kBearingPerRad)] = b;
      residual.by[indexOf(NoiseTerm::kBearingPerRad2)] = b * b;
      return;
    }
    residual.by[indexOf(NoiseTerm::kRangePerMetre)] = expected[i];
    residual.by[indexOf(NoiseTerm::kRangePerMetreRad)] = expected[i] * b;
    residual.by[indexOf(NoiseTerm::kRangePerMetreRad2)] = expected[i] * b * b;
  }

  static bool takeSides(const Sides& sides, std::size_t i, NoiseResidual& residual) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (sides.apart[k] == 0.0) continue;
      if (i >= sides.before[k].size() || i >= sides.after[k].size()) return false;
      double change = sides.after[k][i] - sides.before[k][i];
      if (residual.isAngle) change = wrapAngle(change);
      if (!std::isfinite(change)) return false;
      if (!residual.isAngle && std::abs(change) > 2.0 * kEdge) return false;
      residual.by[k + 2] = change / sides.apart[k];
    }
    return true;
  }

  const TableInfo& tables_;
  std::span<const NoiseLog> logs_;
  const NoiseLearning& how_;
  ByNoiseTerm<double> already_{};
  std::size_t everyReading_ = 1;
  std::size_t everyValue_ = 1;
  std::size_t readings_ = 0;
  std::vector<NoiseResidual> residuals_;
};

/// Returns the asked terms that the existing kinds of values depend on.
ByNoiseTerm<bool> wantedOf(const ByNoiseTerm<bool>& asked,
                           const std::vector<NoiseResidual>& residuals) {
  ByNoiseTerm<bool> wanted = asked;
  const auto isAngle = [](const NoiseResidual& r) { return r.isAngle; };
  const bool hasAngles = std::any_of(residuals.begin(), residuals.end(), isAngle);
  const bool hasRanges = !std::all_of(residuals.begin(), residuals.end(), isAngle);
  wanted[indexOf(NoiseTerm::kRangeBias)] &= hasRanges;
  wanted[indexOf(NoiseTerm::kBearingBias)] &= hasAngles;
  for (std::size_t k = indexOf(NoiseTerm::kRangePerMetre); k < kNoiseTerms; ++k)
    wanted[k] &= std::any_of(residuals.begin(), residuals.end(),
                             [k](const NoiseResidual& r) { return r.by[k] != 0.0; });
  // A turned mount offsets all bearings, as their bias does, so only the bias is fitted.
  wanted[indexOf(NoiseTerm::kMountTheta)] &= !hasAngles;
  return wanted;
}

}  // namespace

void NoiseLogger::look(const SensorContainer& container, NoiseLog& log) {
  for (const auto& data : container.all()) {
    if (!data->localizes() || data->sequence() == 0) continue;
    std::uint64_t& seen = seen_[data.get()];
    if (seen == data->sequence()) continue;
    seen = data->sequence();
    const auto words = data->getData();
    if (words.empty()) continue;
    log.readings[toText(data->id())].push_back({data->stamp(), {words.begin(), words.end()}});
  }
}

LearnedNoise learnNoise(std::span<SensorData* const> features, const TableInfo& tables,
                        std::span<const NoiseLog> logs, const NoiseLearning& how) {
  LearnedNoise learned;
  ByNoiseTerm<double> already{};
  Residuals residuals(tables, logs, how);
  for (int round = 0; round < kLinearizations; ++round) {
    const std::vector<NoiseResidual> all = residuals.of(features, already);
    if (all.empty())
      throw std::runtime_error(
          "no reading can be compared with what is expected where the robot was");
    learned.readings = residuals.readings();
    try {
      learned.fit = fitNoise(all, wantedOf(how.wanted, all), already);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(error.what());
    }
    // Biases need no linearization.
    bool isSame = true;
    for (std::size_t k = 2; k <= indexOf(NoiseTerm::kLatency); ++k) {
      isSame = isSame && std::abs(already[k] - learned.fit.terms[k].value) < 1e-4;
      already[k] = learned.fit.terms[k].value;
    }
    if (isSame) break;
  }
  return learned;
}

}  // namespace ortung
