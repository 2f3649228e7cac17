#pragma once

#include <cstddef>

#include "Constant.hpp"

/// Constants of the folder motion: motion without readings, and whether odometry is trusted. Each
/// comment says what the constant is, its unit, and where its value comes from; docs/constants.md
/// shows what changes on recordings if it is halved or doubled.
namespace ortung::tuning {

/// CarriedOn: an estimate between two updates.
namespace carried {

/// Number of samples of a motion model that give its mean and covariance if it does not know them.
/// Cost: the mean is off by a thirtieth of the noise's sigma, and a prediction takes microseconds.
ORTUNG_CONSTANT(carried, kCopies, std::size_t{1024});

}  // namespace carried

/// LiftRides: rides of lifts.
namespace lifts {

/// [s] Mean time after which a robot that stands in a lift may be at any of its stops. Chosen by
/// hand: doors close and a lift comes to the next floor within a few seconds, and until then the
/// floor has to be open.
ORTUNG_CONSTANT(lifts, kSeconds, 8.0);
/// [m] Longest way between two readings of a robot that stands; turns count as in common. Chosen by
/// hand: odometry of a robot that stands counts millimetres.
ORTUNG_CONSTANT(lifts, kStands, 0.01);

}  // namespace lifts

/// Odometry: its errors, learned on the way.
namespace odometry {

/// [share] Prior sigma of the error in scale of ways and of turns: raw odometry of the logs errs by
/// up to 18 %, that of most robots by a few.
ORTUNG_CONSTANT(odometry, kScale, 0.05);
/// [rad/m] Prior sigma of the turn per metre that odometry does not count: wheels 0.4 m apart one
/// of which is 1 % larger turn a robot by 0.025 rad per metre.
ORTUNG_CONSTANT(odometry, kVeer, 0.03);
/// [m] Prior sigma of how far ahead of the point between the wheels the robot's frame is, whose
/// pose the readings tell. Raw logs have it by 3 to 10 cm; how far the scanner is ahead is easily
/// measured wrong by a few.
ORTUNG_CONSTANT(odometry, kAhead, 0.1);
/// [m] Sigma of what maps, tables and correlated readings leave open of a position by readings
/// alone. Chosen by hand.
ORTUNG_CONSTANT(odometry, kMetres, 0.03);
/// [rad] Likewise of a heading. Chosen by hand.
ORTUNG_CONSTANT(odometry, kRadians, 0.01);
/// [rad] Prior sigma of how far the robot's frame is turned against where it drives: a scanner is
/// easily mounted a degree off.
ORTUNG_CONSTANT(odometry, kTurned, 0.02);
/// [m + rad] Way after which poses by readings alone are compared. Chosen by hand: on less, delays
/// between odometry and readings look like errors.
ORTUNG_CONSTANT(odometry, kWay, 1.0);
/// [m + rad] Longest way on which odometry is compared with the same pose. Chosen by hand.
ORTUNG_CONSTANT(odometry, kLongest, 5.0);
/// Ratio of the variance by the motion model's noise to that by readings from which a way is long
/// enough: half of the ratio of the greatest noise to the least.
ORTUNG_CONSTANT(odometry, kClear, 16.0);
/// [share/sqrt(m), share/sqrt(rad)] Drift of the errors in scale, since loads, tyres and floors
/// change. Chosen by hand: 5 % in 100 m.
ORTUNG_CONSTANT(odometry, kScaleDrift, 0.005);
/// [rad/m/sqrt(m)] Drift of the turn per metre. Chosen by hand.
ORTUNG_CONSTANT(odometry, kVeerDrift, 0.001);
/// [share] Greatest error in scale that is believed. Chosen by hand.
ORTUNG_CONSTANT(odometry, kMostScale, 0.5);
/// [rad/m] Greatest turn per metre that is believed. Chosen by hand.
ORTUNG_CONSTANT(odometry, kMostVeer, 0.3);
/// [m] Greatest distance of the robot's frame from that point that is believed. Chosen by hand:
/// half of a large robot.
ORTUNG_CONSTANT(odometry, kMostAhead, 0.5);
/// [rad] Greatest turn of the robot's frame that is believed. Chosen by hand.
ORTUNG_CONSTANT(odometry, kMostTurned, 0.3);
/// Of so many samples one is moved by all of the motion model's noise, however good odometry is.
/// Chosen by hand: of the smallest set of samples dozens.
ORTUNG_CONSTANT(odometry, kOfAllNoise, std::size_t{8});
/// [nats] Evidence that it takes before less or more noise is believed than the motion model has.
/// Chosen by hand.
ORTUNG_CONSTANT(odometry, kCaution, 5.0);
/// [nats] Most that one pose says of the noise, as it may be an outlier. Chosen by hand.
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
