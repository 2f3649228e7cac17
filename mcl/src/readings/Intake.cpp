#include "Intake.hpp"

#include <algorithm>
#include <utility>

#include "Moved.hpp"
#include "ReadingsTuning.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

using namespace tuning::intake;

}  // namespace

Intake::Look Intake::look(const SensorContainer& container, Timestamp ofBelief, bool trustsOdometry,
                          Timestamp delay) {
  const SensorContainer::ReadLock lock = container.read();
  Look look;
  look.clockSetTo = clockSetBack(container, ofBelief);
  if (look.clockSetTo) {
    forget();
    ofBelief = *look.clockSetTo;
    passOver(container, ofBelief + fromSeconds(kTimeJump));
  }
  takeOdometry(container);
  frozen_.look(container);
  for (const auto& data : container.all()) {
    if (frozen_.has(*data) || !isNews(*data, ofBelief, trustsOdometry, delay))
      continue;  // without making a weigher
    if (std::shared_ptr<const Weigher> weigher = data->weigher())
      look.news[data->stamp()].push_back({data.get(), data->sequence(), std::move(weigher)});
  }
  return look;
}

void Intake::followOdometry(const SensorContainer& container) {
  const SensorContainer::ReadLock lock = container.read();
  takeOdometry(container);
}

void Intake::used(const std::vector<NewReading>& news, Timestamp stamp,
                  const std::optional<Pose2>& odometry) {
  for (const NewReading& one : news)
    uses_[one.feature] = {one.sequence, stamp, odometry.value_or(Pose2{})};
}

void Intake::forget() {
  uses_.clear();
  silence_.forget();
  frozen_.forget();
  odometrySequence_ = 0;
  looksBehind_ = 0;
  motion_.forget();
}

void Intake::countAgain(Timestamp since) {
  std::erase_if(uses_, [&](const auto& use) { return use.second.stamp >= since; });
}

/// Readings older than the belief are late and do not count. But if all readings are much older,
/// the clock itself was set back: then the belief stays, and what is known of times is forgotten.
/// The same holds if all that come for some time are much older: a single stamp in the future must
/// not blind the filter until then. Features derived from the belief are as old as the belief, so
/// only odometry and features that localize are considered here.
std::optional<Timestamp> Intake::clockSetBack(const SensorContainer& container,
                                              Timestamp ofBelief) {
  std::optional<Timestamp> newest;
  std::optional<Timestamp> newestToCome;
  for (const auto& data : container.all()) {
    const bool isAsked = data->localizes() || isOdometry(*data);
    if (data->sequence() == 0 || !isAsked) continue;
    newest = std::max(newest.value_or(data->stamp()), data->stamp());
    if (std::exchange(seen_[data.get()], data->sequence()) != data->sequence())
      newestToCome = std::max(newestToCome.value_or(data->stamp()), data->stamp());
  }
  const auto isBehind = [ofBelief](Timestamp t) { return t + fromSeconds(kTimeJump) < ofBelief; };
  if (!newest || isBehind(*newest)) return newest;
  if (!newestToCome) return std::nullopt;
  if (!isBehind(*newestToCome)) {
    looksBehind_ = 0;
    return std::nullopt;
  }
  if (looksBehind_++ == 0) behindSince_ = *newestToCome;
  const double seconds = toSeconds(*newestToCome - behindSince_);
  // If the clock was set back once more, the time is counted from there.
  if (seconds < 0.0) behindSince_ = *newestToCome;
  if (looksBehind_ < kLooksBehind || seconds < kSecondsBehind) return std::nullopt;
  return newestToCome;
}

/// Marks readings later than @p stamp as used, since their stamps are from before the clock was set
/// back.
void Intake::passOver(const SensorContainer& container, Timestamp stamp) {
  for (const auto& data : container.all())
    if (data->sequence() > 0 && data->stamp() > stamp)
      uses_[data.get()] = {data->sequence(), 0, {}};
}

/// The result is cached, since the format of a feature does not change and looking it up makes a
/// string.
bool Intake::isOdometry(const SensorData& data) {
  const auto known = isOdometry_.find(&data);
  if (known != isOdometry_.end()) return known->second;
  return isOdometry_.emplace(&data, isOf(data, formats::kOdometry)).first->second;
}

/// Gives the motion model the readings of the first feature that is odometry.
void Intake::takeOdometry(const SensorContainer& container) {
  newestOdometry_.reset();
  for (const auto& data : container.all()) {
    if (data->sequence() == 0 || !isOdometry(*data)) continue;
    newestOdometry_ = data->stamp();
    const auto reading =
        data->sequence() != odometrySequence_ ? readingAs<OdometryData>(*data) : std::nullopt;
    if (reading)
      motion_.follow(data->stamp(),
                     {reading->pose, reading->translationalVelocity, reading->rotationalVelocity,
                      reading->motionData, reading->lateralVelocity});
    odometrySequence_ = data->sequence();
    break;
  }
  silence_.hear(newestOdometry_);
}

bool Intake::isNews(const SensorData& data, Timestamp ofBelief, bool trustsOdometry,
                    Timestamp delay) const {
  const auto it = uses_.find(&data);
  if (it == uses_.end()) return true;
  const Use& last = it->second;
  if (data.sequence() == last.sequence || data.stamp() < ofBelief) return false;
  const std::optional<Pose2> odometry = motion_.odometryAt(data.stamp() - delay);
  return !trustsOdometry || !odometry || odometrySilentSince(data.stamp() - delay) ||
         hasMoved(config_, last.odometry, *odometry) ||
         toSeconds(data.stamp() - last.stamp) >= config_.maxInterval;
}

}  // namespace ortung
