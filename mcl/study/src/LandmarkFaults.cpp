#include <algorithm>
#include <utility>

#include "Disturbance.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

/// Of each list a share of the sightings, drawn anew, is of any landmark in any place in sight.
class FalseSightings : public Disturbance {
 public:
  FalseSightings(double share, LandmarksData::Config landmarks, const Random& random)
      : share_(share), landmarks_(std::move(landmarks)), random_(random) {}

  bool alter(Message& message, double, bool isNow) override {
    if (!isNow || message.words.size() % kWordsASighting != 0) return true;
    const bool isAllAround = landmarks_.fieldOfView <= 0.0 || landmarks_.fieldOfView > kTurn;
    const double halfView = 0.5 * (isAllAround ? kTurn : landmarks_.fieldOfView);
    const auto count = static_cast<double>(landmarks_.identities.size());
    for (std::size_t i = 0; i < message.words.size(); i += kWordsASighting) {
      const bool isHit = random_.uniform() < share_;
      const auto which = static_cast<std::size_t>(random_.uniform() * count);
      const double range = random_.uniform() * landmarks_.maxRange;
      const double bearing = (2.0 * random_.uniform() - 1.0) * halfView;
      if (!isHit) continue;  // all drawn: sightings do not depend on each other
      message.words[i] = landmarks_.identities[std::min(which, landmarks_.identities.size() - 1)];
      message.words[i + 1] = words::fromMetres(range);
      message.words[i + 2] = words::fromAngle(bearing);
    }
    return true;
  }

 private:
  static constexpr std::size_t kWordsASighting = 3;
  double share_;
  LandmarksData::Config landmarks_;
  Random random_;
};

}  // namespace

std::unique_ptr<Disturbance> makeLandmarksFault(const Fault& fault,
                                                const LandmarksData::Config& landmarks,
                                                const Random& random) {
  return std::make_unique<FalseSightings>(fault.values.at(0), landmarks, random);
}

}  // namespace ortung
