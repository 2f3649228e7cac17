#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/server/ServedFeature.hpp"

namespace ortung {

/// The rectangle that nothing leaves, in the field frame [m].
struct FieldBounds {
  double xMin = 0.0;
  double yMin = 0.0;
  double xMax = 0.0;
  double yMax = 0.0;
};

/// Something movable that is no robot.
struct ServedObject {
  std::string name;  ///< unique name for placeObject(), one printable word
  std::string kind;  ///< "ball", ...
  std::string colour = {};
  double radius = 0.0;  ///< radius of the smallest circle around it [m]
  double height = 0.0;  ///< [m]
};

/// What DESCRIBE world says.
struct WorldDescription {
  std::string name;
  std::string fingerprint;                 ///< digest of the world; "": not known
  std::string kind;                        ///< "simulation", "record" or "robot"
  std::optional<FieldBounds> bounds = {};  ///< nothing: they are not known
  std::vector<ServedObject> objects = {};
  std::optional<Timestamp> length = {};  ///< length of the time line that clients may seek on [us]
};

/// What a served world is, what is on its field, and what clients may use there. A part of
/// ServedWorld, as which it is called.
class ORTUNG_API ServedField {
 public:
  virtual ~ServedField();

  virtual WorldDescription describe() const = 0;
  /// Names of the plugins that clients may use in the configurations of robots.
  virtual std::vector<std::string> plugins() const = 0;
  /// Players that may be started here, a line each, and behind it one for each of their options
  /// (docs/protocol.md).
  virtual std::vector<std::string> players() const = 0;
  /// Robots that players may be given by name, a line "robot NAME TEXT" each.
  virtual std::vector<std::string> robotKinds() const = 0;

  /// What stands and is painted on the field, one line each: a kind and keys (docs/protocol.md).
  virtual std::vector<std::string> field() const = 0;
  /// Features of the world's true state, for spectators, in the order of their readings: for
  /// clients they are those of robot 0. None: nothing.
  virtual std::vector<ServedFeature> truthFeatures() const = 0;
  /// How it is now; valid until the next call of anything.
  virtual std::span<Message> truth() = 0;
  /// @param object a name of describe()
  virtual void placeObject(const std::string& object, const Pose2& pose) = 0;
};

}  // namespace ortung
