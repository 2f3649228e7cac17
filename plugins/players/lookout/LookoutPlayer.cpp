// Stays where it was placed and reports its pose, and where it sees robots and balls, to its team.
// Team mates with the sensor plugin `teammate` read that like any sensor (paper, section 6).
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "ortung/base/Angles.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {
namespace {

class LookoutPlayer : public Player {
 public:
  explicit LookoutPlayer(const Parameters& p)
      : of_(p.textOr("of", "")),
        rangeSigma_(p.numberOr("range_sigma_m", 0.03, {1e-3, 10.0})),
        rangeSigmaPerMetre_(p.numberOr("range_sigma_per_m", 0.03, {0.0, 1.0})),
        bearingSigma_(radians(p.numberOr("bearing_sigma_deg", 1.0, {1e-2, 90.0}))),
        period_(p.numberOr("period_s", 0.1, {0.0, 60.0})) {}

  std::filesystem::path robotFile() const override { return "lookout.toml"; }
  double period() const override { return period_; }

  bool senseAndAct(PlayerSeat& seat) override {
    listen(seat);
    const auto pose = seat.container().get<PoseData>({.type = "groundTruth"});
    if (!pose) return true;        // it has no pose yet
    constexpr double kOwn = 0.01;  // standard deviation of its pose [m], [rad]
    const double s = kOwn * kOwn;
    tell(seat, {Place::Kind::kRobot, seat.name(), {*pose, {s, 0, 0, 0, s, 0, 0, 0, s}}});
    tellWhatItSees(seat, *pose, "robots");
    tellWhatItSees(seat, *pose, "ball");
    return true;
  }

 private:
  /// A sighting within this distance of a robot's reported place is that robot [m].
  static constexpr double kSame = 0.6;

  static void tell(PlayerSeat& seat, const Place& place) { seat.say(toText(place)); }

  /// Takes the places that the others report.
  void listen(const PlayerSeat& seat) {
    for (const Heard& heard : seat.heard()) {
      const auto place = placeIn(heard.text);
      constexpr std::size_t kMost = 100;
      const bool isOwn = place && place->kind == Place::Kind::kRobot && place->name == heard.from;
      if (isOwn && (mates_.size() < kMost || mates_.contains(heard.from)))
        mates_[heard.from] = {place->fix.pose.x, place->fix.pose.y};
    }
  }

  void tellWhatItSees(PlayerSeat& seat, const Pose2& pose, const char* feature) {
    ObjectsData::Reading objects;
    Pose2 eye;
    {
      const SensorContainer::ReadLock lock = seat.container().read();
      const SensorData* seen = seat.container().find({.feature = feature});
      if (seen == nullptr || seen->sequence() == told_[feature]) return;  // nothing new
      told_[feature] = seen->sequence();
      objects = readingAs<ObjectsData>(*seen).value_or(objects);
      eye = pose * seen->mount();
    }
    const bool isBall = std::string_view(feature) == "ball";
    for (const ObjectsData::Object& object : objects) {
      const Place place = placeOf(object, eye, isBall);
      if (!isBall && (of_.empty() || isMate(place))) continue;
      tell(seat, place);
      return;  // the others can't be distinguished
    }
  }

  bool isMate(const Place& place) const {
    return std::any_of(mates_.begin(), mates_.end(), [&](const auto& mate) {
      return std::hypot(mate.second.x - place.fix.pose.x, mate.second.y - place.fix.pose.y) < kSame;
    });
  }

  /// Returns the place of a sighting in the field frame, with the errors of range and bearing as
  /// its covariance.
  Place placeOf(const ObjectsData::Object& object, const Pose2& eye, bool isBall) const {
    const double angle = eye.theta + object.bearing;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double along = rangeSigma_ + rangeSigmaPerMetre_ * object.range;
    const double across = std::max(bearingSigma_ * object.range, 1e-3);
    const double a = along * along;
    const double b = across * across;
    const double xy = (a - b) * c * s;
    constexpr double kHeading = Place::kNoHeading * Place::kNoHeading;
    return {isBall ? Place::Kind::kBall : Place::Kind::kRobot,
            isBall ? "ball" : of_,
            {{eye.x + object.range * c, eye.y + object.range * s, 0.0},
             {a * c * c + b * s * s, xy, 0.0, xy, a * s * s + b * c * c, 0.0, 0.0, 0.0, kHeading}}};
  }

  std::string of_;
  double rangeSigma_;  ///< standard deviation of range [m]
  double rangeSigmaPerMetre_;
  double bearingSigma_;  ///< standard deviation of bearing [rad]
  double period_;        ///< time between two looks [s]
  std::map<std::string, FloorPoint> mates_;
  /// Sequence number of each feature's last reading that was reported.
  std::map<std::string, std::uint64_t, std::less<>> told_;
};

struct LookoutHelp : PlayerHelp {
  explicit LookoutHelp(const Parameters&)
      : PlayerHelp("stays in place and reports to its team where it sees robots and balls",
                   {{"of", "name", "", "the robot that an unidentified one is taken for"},
                    {"range_sigma_m", "m", "0.03", "error of its camera's distances"},
                    {"range_sigma_per_m", "m/m", "0.03", "growth of that error per metre"},
                    {"bearing_sigma_deg", "deg", "1", "error of its camera's bearings"},
                    {"period_s", "s", "0.1", "time between two looks"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lookout", ortung::provide<ortung::Player, ortung::LookoutPlayer>("lookout"),
               ortung::provide<ortung::PlayerHelp, ortung::LookoutHelp>("lookout"));
