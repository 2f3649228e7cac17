#include <memory>
#include <stdexcept>

#include "FieldSearch.hpp"
#include "HotCall.hpp"
#include "Kld.hpp"
#include "Resampling.hpp"
#include "SmallField.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung::instructions {
namespace {

constexpr std::size_t kSamples = 2'000;

void moveSamples() {
  SampleSet samples = bench::concentratedCloud(kSamples);
  OdometryMotion().sampleMotion({samples.x, samples.y, samples.theta}, {0.05, 0.002, 0.03}, 1, 2,
                                0);
}

void addResampling(HotCalls& calls) {
  std::vector<float> logWeights(kSamples);
  const SampleSet samples = bench::concentratedCloud(kSamples);
  scannerWith(ScanData::Perception::kRays)->getProbability(samples.view(), logWeights);
  calls.push_back({"resample", [=] {
                     const std::vector<double> weights = normalized(logWeights);
                     const std::vector<std::uint32_t> drawn = lowVariance(weights, kSamples, 0.5);
                     const MclConfig config;
                     const PoseBins bins(config, samples.view());
                     estimateOf(bins, samples.view(), weights);
                   }});
}

/// A robot that goes to and fro, as its wheels and its scanner tell.
class Walker {
 public:
  Walker() : mcl_(config(), smallRegion(), std::make_unique<OdometryMotion>()) {
    container_.add(std::make_unique<OdometryData>(SensorId{"Hot", "Odometry", "Pose"}));
    container_.add(bench::learnedScan(ScanData::Perception::kRays, 2.0, smallRegion()));
    mcl_.startAt(place(), 0.1, 0.05);
  }
  /// @throws std::logic_error if the filter saw no reason for an update
  void update() {
    ++steps_;
    const Timestamp stamp = steps_ * 100'000;
    const OdometryData::Reading odometry{
        .pose = place(), .translationalVelocity = 0.0, .rotationalVelocity = 0.0, .motionData = {}};
    ScanData::encode(scans_[steps_ % 2], bench::kMaxRange, words_);
    container_.all()[0]->setData(stamp, OdometryData::encode(odometry));
    container_.all()[1]->setData(stamp, words_);
    if (!mcl_.update(container_)) throw std::logic_error("there was no update");
  }

 private:
  static MclConfig config() {
    MclConfig config;
    config.minSamples = config.maxSamples = kSamples;
    return config;
  }
  static Pose2 placeAt(int side) { return bench::kRobot * Pose2{0.3 * side, 0.0, 0.0}; }
  Pose2 place() const { return placeAt(steps_ % 2); }

  SensorContainer container_;
  Mcl mcl_;
  int steps_ = 0;
  std::vector<float> scans_[2] = {bench::scanAt(placeAt(0)), bench::scanAt(placeAt(1))};
  std::vector<std::uint32_t> words_;
};

}  // namespace

void addFiltering(HotCalls& calls) {
  calls.push_back({"move_samples", moveSamples});
  addResampling(calls);
  const auto robot = std::make_shared<Walker>();
  for (int i = 0; i < 10; ++i) robot->update();  // until it is sure
  calls.push_back({"update", [=] { robot->update(); }});
  const std::shared_ptr<const Weigher> reading =
      scannerWith(ScanData::Perception::kRays)->weigher();
  calls.push_back({"search", [=] {
                     FieldSearch search(smallRegion(), {});
                     search.begin({reading});
                     search.work(1e9);
                   }});
}

}  // namespace ortung::instructions
