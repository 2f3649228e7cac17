#include <algorithm>
#include <cmath>
#include <vector>

#include "Disturbance.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

constexpr double kNearest = 0.4;            ///< least distance of their visible side [m]
constexpr double kFarthest = 1.5;           ///< [m]
constexpr double kSector = 40.0 * kDegree;  ///< sector of the scan for each of them, roughly
constexpr double kLeastCover = 0.55;        ///< share of a sector that its person hides
constexpr double kMostCover = 0.75;
constexpr double kShortestPeriod = 8.0;  ///< shortest period of their coming and going [s]
constexpr double kLongestPeriod = 25.0;

/// A leg or a body: a circle that always covers the same share of its sector of the scan, and goes
/// to and fro in it. Its place depends on time alone, so that scans at any rate see the same
/// people.
struct Person {
  double middle;     ///< bearing about which they go [rad]
  double swing;      ///< largest angle from there [rad]
  double halfWidth;  ///< half the angle that the person hides [rad]
  double near;       ///< least distance of the person's centre [m]
  double far;        ///< [m]
  double bearingPeriod;
  double bearingPhase;
  double distancePeriod;
  double distancePhase;

  double bearing(double seconds) const {
    return middle + swing * std::sin(kTurn * (seconds / bearingPeriod + bearingPhase));
  }
  double distance(double seconds) const {
    const double share = std::sin(kTurn * (seconds / distancePeriod + distancePhase));
    return (near + far) / 2 + (far - near) / 2 * share;
  }
};

Person makePerson(double sectorBegin, double sector, Random& random) {
  Person p{};
  const double cover = random.uniform(kLeastCover, kMostCover);
  p.halfWidth = cover * sector / 2;
  p.middle = sectorBegin + sector / 2;
  p.swing = (1 - cover) * sector / 2;
  // The nearest point is at d (1 - sin w), the farthest visible one at d cos w.
  const double least = kNearest / (1 - std::sin(p.halfWidth));
  const double most = kFarthest / std::cos(p.halfWidth);
  const double middle = random.uniform(least, most);
  const double swing = std::min({middle - least, most - middle, 0.3});
  p.near = middle - swing;
  p.far = middle + swing;
  p.bearingPeriod = random.uniform(kShortestPeriod, kLongestPeriod);
  p.bearingPhase = random.uniform();
  p.distancePeriod = random.uniform(kShortestPeriod, kLongestPeriod);
  p.distancePhase = random.uniform();
  return p;
}

class Crowd : public Disturbance {
 public:
  Crowd(const ScanData::Config& scan, Random random) : scan_(scan) {
    const double span = scan.beams * scan.angleStep;
    const int count = std::max(1, static_cast<int>(std::ceil(span / kSector - 1e-9)));
    const double sector = span / count;
    for (int i = 0; i < count; ++i)
      people_.push_back(
          makePerson(scan.firstAngle - scan.angleStep / 2 + i * sector, sector, random));
  }

  bool alter(Message& message, double seconds, bool isNow) override {
    if (!isNow || message.words.size() != static_cast<std::size_t>(scan_.beams)) return true;
    for (const Person& person : people_) hide(message.words, person, seconds);
    return true;
  }

 private:
  void hide(std::vector<std::uint32_t>& scan, const Person& person, double seconds) const {
    const double bearing = person.bearing(seconds);
    const double distance = person.distance(seconds);
    const double radius = distance * std::sin(person.halfWidth);
    const auto beamAt = [&](double angle) { return (angle - scan_.firstAngle) / scan_.angleStep; };
    const int first = std::max(0, static_cast<int>(std::ceil(beamAt(bearing - person.halfWidth))));
    const int last =
        std::min(scan_.beams - 1, static_cast<int>(std::floor(beamAt(bearing + person.halfWidth))));
    for (int i = first; i <= last; ++i) {
      const double off = scan_.firstAngle + i * scan_.angleStep - bearing;
      const double beside = distance * std::sin(off);
      const double range =
          distance * std::cos(off) - std::sqrt(std::max(0.0, radius * radius - beside * beside));
      std::uint32_t& word = scan[static_cast<std::size_t>(i)];
      const std::uint32_t seen = words::fromMetres(range);
      word = word == 0 ? seen : std::min(word, seen);
    }
  }

  ScanData::Config scan_;
  std::vector<Person> people_;
};

}  // namespace

std::unique_ptr<Disturbance> makeCrowd(const ScanData::Config& scan, Random random) {
  return std::make_unique<Crowd>(scan, random);
}

}  // namespace ortung
