#pragma once

#include <cstddef>

#include "Constant.hpp"

/// Constants of the room motion: ways without readings, and whether odometry is believed.
/// What each one is, its unit, and where its value comes from; docs/constants.md has what half of
/// it and twice as much change on recordings.
namespace ortung::tuning {

/// CarriedOn: an estimate between two updates.
namespace carried {

/// Copies of the pose that are moved. Cost: the mean is off by a tenth of the noise's sigma, and
/// asking takes microseconds.
ORTUNG_CONSTANT(carried, kCopies, std::size_t{128});

}  // namespace carried

/// Momentum: without odometry.
namespace momentum {

/// [sigma] Greatest velocity, in what the process noise of 1 s allows; more is another place. The
/// tail of a normal distribution beyond it is 6e-5.
ORTUNG_CONSTANT(momentum, kFastest, 4.0);

}  // namespace momentum

/// MotionPieces: long ways.
namespace pieces {

/// [m] Size of a piece in which motion without readings is followed. By hand: short enough that
/// curves stay curves.
ORTUNG_CONSTANT(pieces, kMetres, 0.1);
/// [rad] The same for turns.
ORTUNG_CONSTANT(pieces, kRadians, 0.1);

}  // namespace pieces

/// OdometryTrust: whether odometry is believed.
namespace trust {

/// [m] Distance travelled after which a reading counts whole, since nearer ones err alike. By hand.
ORTUNG_CONSTANT(trust, kIndependent, 0.1);
/// [nats] Lead over motion without odometry at which it is believed again. What is long past counts
/// no more than that against it, either.
ORTUNG_CONSTANT(trust, kRegained, 8.0);
/// [m] Greatest way of odometry that is stationary; 1 rad counts as 1 m. By hand: what wheel
/// encoders resolve.
ORTUNG_CONSTANT(trust, kStationary, 0.002);

}  // namespace trust

}  // namespace ortung::tuning
