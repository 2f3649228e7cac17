#pragma once

#include <cstddef>

#include "Constant.hpp"

/// Constants of the folder motion: motion without readings, and whether odometry is trusted. Each
/// comment says what the constant is, its unit, and where its value comes from; docs/constants.md
/// shows what changes on recordings if it is halved or doubled.
namespace ortung::tuning {

/// CarriedOn: an estimate between two updates.
namespace carried {

/// Number of samples of the motion model that give its mean and covariance. Cost: the mean is off
/// by a thirtieth of the noise's sigma, and a prediction takes microseconds.
ORTUNG_CONSTANT(carried, kCopies, std::size_t{1024});

}  // namespace carried

/// Odometry: its errors, learned on the way.
namespace odometry {

/// [share] Prior sigma of the error in scale of ways and of turns: raw odometry of the logs errs by
/// up to 18 %, that of most robots by a few.
ORTUNG_CONSTANT(odometry, kScale, 0.05);
/// [rad/m] Prior sigma of the turn per metre that odometry does not count: 0.6
/// degrees. With three times as much, sena_telecom is lost for longer while there are no readings.
ORTUNG_CONSTANT(odometry, kVeer, 0.01);
/// [share/sqrt(m), share/sqrt(rad)] Drift of the errors in scale, since loads, tyres and floors
/// change. Chosen by hand: 5 % in 100 m.
ORTUNG_CONSTANT(odometry, kScaleDrift, 0.005);
/// [rad/m/sqrt(m)] Drift of the turn per metre. Chosen by hand.
ORTUNG_CONSTANT(odometry, kVeerDrift, 0.001);
/// [share] Greatest error in scale that is believed. Chosen by hand.
ORTUNG_CONSTANT(odometry, kMostScale, 0.5);
/// [rad/m] Greatest turn per metre that is believed. Chosen by hand.
ORTUNG_CONSTANT(odometry, kMostVeer, 0.3);
/// [nats] Evidence that it takes before less noise is believed than the motion model has. Chosen by
/// hand.
ORTUNG_CONSTANT(odometry, kCaution, 5.0);
/// [nats] Most that one pose says against less noise, as it may be an outlier. Chosen by hand.
ORTUNG_CONSTANT(odometry, kMostNats, 8.0);
/// [share] How much of the evidence is left after a pose, so that about a hundred count. Chosen by
/// hand.
ORTUNG_CONSTANT(odometry, kKept, 0.99);

}  // namespace odometry

/// MotionPieces: long paths without readings.
namespace pieces {

/// [m or rad] Size of the pieces in which motion without readings is followed. Chosen by hand:
/// short enough that curves stay curves.
ORTUNG_CONSTANT(pieces, kSize, 0.1);

}  // namespace pieces

/// OdometryTrust: whether odometry is trusted.
namespace trust {

/// [m] Distance travelled after which a reading counts fully, since the errors of nearer ones are
/// correlated. Chosen by hand.
ORTUNG_CONSTANT(trust, kIndependent, 0.1);
/// [m] Greatest distance travelled by odometry at which the robot still counts as stationary; 1 rad
/// counts as 1 m. Chosen by hand: what wheel encoders resolve.
ORTUNG_CONSTANT(trust, kStationary, 0.002);

}  // namespace trust

}  // namespace ortung::tuning
