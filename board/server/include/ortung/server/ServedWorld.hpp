#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/server/ServeError.hpp"
#include "ortung/server/ServedField.hpp"
#include "ortung/server/ServedRobots.hpp"
#include "ortung/server/ServedTime.hpp"

namespace ortung {

/// What the message board serves: a simulation, a record as if it were one, a running robot.
///
/// It has no defaults, so that a world that forwards calls to another one (ForwardedWorld) can
/// forget none; a world of your own derives from PlainWorld, which has them.
/// Not thread-safe: one thread owns it. Refusals are ServeErrors, or the errors of configurations
/// and plugins.
class ORTUNG_API ServedWorld : public ServedField, public ServedTime, public ServedRobots {
 public:
  ~ServedWorld() override;
};

}  // namespace ortung
