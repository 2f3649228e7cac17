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
/// by a tenth of the noise's sigma, and a prediction takes microseconds.
ORTUNG_CONSTANT(carried, kCopies, std::size_t{128});

}  // namespace carried

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
