#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ortung/base/Pose2.hpp"

namespace ortung::ros2 {

/// What the parameters of amcl mean for a localization.
struct AmclSettings {
  std::string base = "base_footprint", odom = "odom", map = "map";  ///< frames
  std::string scanTopic = "scan", mapTopic = "map";
  bool isFirstMapOnly = false;      ///< whether later maps are left out
  bool tellsTransform = true;       ///< whether map -> odom is told
  double transformTolerance = 1.0;  ///< how far ahead it is valid [s]
  std::optional<Pose2> initialPose;
  bool alwaysResets = false;          ///< whether initialPose counts more than where it was last
  std::filesystem::path belief;       ///< kept over runs; "": none
  double saveSeconds = 10.0;          ///< between two times at which the belief is kept [s]
  std::optional<std::uint64_t> seed;  ///< of all random numbers
  double maxRange = 0.0;              ///< scans are cut there [m]; 0: where they say
  bool startsItself = true;           ///< whether it is active without a lifecycle manager
  double heartbeatSeconds = 0.1;      ///< of the bond to that [s]; 0: no bond
  std::string robotToml;              ///< [mcl] and [motion] of a robot file
};

/// The parameters of Nav2's amcl, by which a robot that ran it is localized without a file of
/// Ortung's. Each one means something here, or has no effect for a reason that can be told; others
/// are refused. One of the filter or of motion that has amcl's own default says nothing about the
/// robot, so Ortung's default stays. Not thread-safe.
class AmclParameters {
 public:
  using Value = std::variant<bool, std::int64_t, double, std::string>;
  /// What is known of a parameter.
  struct Description {
    std::string_view name;
    Value byDefault;          ///< amcl's; tells the type, too
    double least, most;       ///< of a number
    std::string_view effect;  ///< what it does, or why nothing
    enum class Kind : std::uint8_t {
      kFixed,  ///< counts when the node starts
      kLive,   ///< may be changed while it runs
      kNone,   ///< has no effect
    } kind;
    bool leavesDefault = false;  ///< whether amcl's default leaves Ortung's
  };

  AmclParameters();

  /// All of them, by name.
  static const std::vector<Description>& all();
  static const Description* find(std::string_view name);

  /// Sets one from a text of YAML. @throws std::invalid_argument if there is no such parameter, or
  /// for a value of another type or beyond its range, with what was expected
  void setText(const std::string& name, const std::string& yaml);
  /// Sets one, or checks only whether it could be. @throws as setText()
  void set(const std::string& name, const Value& value);
  static void check(const std::string& name, const Value& value);

  const Value& get(std::string_view name) const;
  AmclSettings settings() const;
  /// Which of those that were set have no effect, and why, for the start of a run; "" if none.
  /// @param hasRobotFile whether robot and filter are told by a file of Ortung's
  std::string remark(bool hasRobotFile) const;

 private:
  double number(std::string_view name) const;
  bool flag(std::string_view name) const { return std::get<bool>(get(name)); }
  const std::string& text(std::string_view name) const { return std::get<std::string>(get(name)); }
  bool isOwn(std::string_view name) const;
  std::string mclToml() const;
  std::string motionToml() const;

  std::map<std::string, Value, std::less<>> values_;
  std::vector<std::string> given_;  ///< names that were set, in their order
};

}  // namespace ortung::ros2
