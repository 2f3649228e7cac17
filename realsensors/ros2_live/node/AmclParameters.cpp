#include "AmclParameters.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "ortung/base/Angles.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung::ros2 {
namespace {

using Kind = AmclParameters::Description::Kind;
constexpr double kMost = 1e9;

constexpr std::string_view kLearned = "the perception of scans is learned of the map";
constexpr std::string_view kAllBeams = "all beams of a scan are weighed";
constexpr std::string_view kChanges = "beams that no longer fit the map are found in another way";
constexpr std::string_view kRecovery = "a place is left for another one by the evidence of scans";
constexpr std::string_view kResampling = "samples are drawn anew when few of them carry the weight";
constexpr std::string_view kStamps = "messages tell their time themselves";
constexpr std::string_view kPlane = "the robot is in the plane of the map";
constexpr std::string_view kSearch = "the whole floor is searched";
constexpr std::string_view kScans = "scans tell it themselves";
constexpr std::string_view kRos = "it is for other parts of ROS";
constexpr std::string_view kBeluga = "it is Beluga's alone";

using Table = std::vector<AmclParameters::Description>;
using Text = std::string;

/// Frames, topics and the transform.
Table framesParameters() {
  return {
      {"base_frame_id", Text("base_footprint"), 0, 0, "frame of the robot", Kind::kFixed},
      {"odom_frame_id", Text("odom"), 0, 0, "frame of odometry", Kind::kFixed},
      {"global_frame_id", Text("map"), 0, 0, "frame of the map", Kind::kFixed},
      {"scan_topic", Text("scan"), 0, 0, "topic of scans", Kind::kFixed},
      {"map_topic", Text("map"), 0, 0, "topic of the map", Kind::kFixed},
      {"first_map_only", false, 0, 0, "whether later maps are left out", Kind::kFixed},
      {"tf_broadcast", true, 0, 0, "whether map -> odom is told", Kind::kLive},
      {"transform_tolerance", 1.0, 0, 10, "how far ahead map -> odom is valid [s]", Kind::kLive},
  };
}

/// Motion and the filter.
Table motionParameters() {
  return {
      {"robot_model_type", Text("nav2_amcl::DifferentialMotionModel"), 0, 0,
       "how the robot moves: DifferentialMotionModel or OmniMotionModel", Kind::kLive},
      {"alpha1", 0.2, 0, 100, "noise of turns by turning", Kind::kLive, true},
      {"alpha2", 0.2, 0, 100, "noise of turns by driving", Kind::kLive, true},
      {"alpha3", 0.2, 0, 100, "noise of ways by driving", Kind::kLive, true},
      {"alpha4", 0.2, 0, 100, "noise of ways by turning", Kind::kLive, true},
      {"alpha5", 0.2, 0, 100, "noise to the side is that along the way", Kind::kNone},
      {"min_particles", std::int64_t{500}, 10, 1e6, "least number of samples", Kind::kLive, true},
      {"max_particles", std::int64_t{2000}, 10, 1e6, "greatest number of samples", Kind::kLive,
       true},
      {"pf_err", 0.05, 1e-3, 0.999, "error of the sampled distribution", Kind::kLive, true},
      {"pf_z", 0.99, 0.1, 9.9, "quantile of that error", Kind::kLive, true},
      {"update_min_d", 0.25, 0, 100, "way after which scans are weighed [m]", Kind::kLive, true},
      {"update_min_a", 0.2, 0, 6.28, "turn after which scans are weighed [rad]", Kind::kLive, true},
      {"resample_interval", std::int64_t{1}, 1, kMost, kResampling, Kind::kNone},
      {"recovery_alpha_slow", 0.0, 0, 1, kRecovery, Kind::kNone},
      {"recovery_alpha_fast", 0.0, 0, 1, kRecovery, Kind::kNone},
  };
}

/// Scans.
Table scansParameters() {
  return {
      {"laser_max_range", 100.0, -1, 1000, "greatest range that counts [m]", Kind::kFixed},
      {"laser_min_range", -1.0, -1, 1000, kScans, Kind::kNone},
      {"laser_model_type", Text("likelihood_field"), 0, 0, kLearned, Kind::kNone},
      {"max_beams", std::int64_t{60}, 1, kMost, kAllBeams, Kind::kNone},
      {"laser_likelihood_max_dist", 2.0, 0, kMost, kLearned, Kind::kNone},
      {"sigma_hit", 0.2, 0, kMost, kLearned, Kind::kNone},
      {"z_hit", 0.5, 0, kMost, kLearned, Kind::kNone},
      {"z_max", 0.05, 0, kMost, kLearned, Kind::kNone},
      {"z_rand", 0.5, 0, kMost, kLearned, Kind::kNone},
      {"z_short", 0.05, 0, kMost, kLearned, Kind::kNone},
      {"lambda_short", 0.1, 0, kMost, kLearned, Kind::kNone},
      {"do_beamskip", false, 0, 0, kChanges, Kind::kNone},
      {"beam_skip_distance", 0.5, 0, kMost, kChanges, Kind::kNone},
      {"beam_skip_threshold", 0.3, 0, kMost, kChanges, Kind::kNone},
      {"beam_skip_error_threshold", 0.9, 0, kMost, kChanges, Kind::kNone},
  };
}

/// Where the robot starts, and what is kept of where it was.
Table startParameters() {
  return {
      {"set_initial_pose", false, 0, 0, "whether initial_pose counts", Kind::kLive},
      {"always_reset_initial_pose", false, 0, 0,
       "whether initial_pose counts more than where the robot was last", Kind::kLive},
      {"initial_pose.x", 0.0, -1e6, 1e6, "where the robot starts [m]", Kind::kLive},
      {"initial_pose.y", 0.0, -1e6, 1e6, "where the robot starts [m]", Kind::kLive},
      {"initial_pose.z", 0.0, -kMost, kMost, kPlane, Kind::kNone},
      {"initial_pose.yaw", 0.0, -1e3, 1e3, "where the robot is headed then [rad]", Kind::kLive},
      {"save_pose_rate", 0.5, -1, 100, "how often the belief is kept [1/s]", Kind::kLive, true},
      {"saved_pose_filepath", Text(), 0, 0, "file that keeps the belief", Kind::kFixed},
      {"initialize_at_saved_pose", false, 0, 0, "whether the belief of that file counts",
       Kind::kFixed},
      {"freespace_downsampling", false, 0, 0, kSearch, Kind::kNone},
      {"random_seed", std::int64_t{-1}, -1, kMost, "seed of random numbers", Kind::kFixed},
  };
}

/// The node itself.
Table nodeParameters() {
  return {
      {"autostart_node", true, 0, 0, "whether it works without a lifecycle manager", Kind::kFixed},
      {"bond_heartbeat_period", 0.1, 0, 100, "of the lifecycle manager's bond [s]", Kind::kFixed},
      {"use_sim_time", false, 0, 0, kStamps, Kind::kNone},
      {"allow_parameter_qos_overrides", true, 0, 0, kRos, Kind::kNone},
      {"introspection_mode", Text("disabled"), 0, 0, kRos, Kind::kNone},
      {"start_type_description_service", true, 0, 0, kRos, Kind::kNone},
  };
}

/// Beluga's own.
Table belugaParameters() {
  return {
      {"initial_pose_topic", Text("initialpose"), 0, 0, kBeluga, Kind::kNone},
      {"selective_resampling", false, 0, 0, kResampling, Kind::kNone},
      {"spatial_resolution_x", 0.5, 0, kMost, kBeluga, Kind::kNone},
      {"spatial_resolution_y", 0.5, 0, kMost, kBeluga, Kind::kNone},
      {"spatial_resolution_theta", 0.175, 0, kMost, kBeluga, Kind::kNone},
      {"execution_policy", Text("seq"), 0, 0, kBeluga, Kind::kNone},
      {"initial_pose.covariance_x", 0.25, 0, kMost, kBeluga, Kind::kNone},
      {"initial_pose.covariance_y", 0.25, 0, kMost, kBeluga, Kind::kNone},
      {"initial_pose.covariance_yaw", 0.0685, 0, kMost, kBeluga, Kind::kNone},
      {"initial_pose.covariance_xy", 0.0, -kMost, kMost, kBeluga, Kind::kNone},
      {"initial_pose.covariance_xyaw", 0.0, -kMost, kMost, kBeluga, Kind::kNone},
      {"initial_pose.covariance_yyaw", 0.0, -kMost, kMost, kBeluga, Kind::kNone},
  };
}

Table table() {
  Table all;
  for (const auto part : {framesParameters, motionParameters, scansParameters, startParameters,
                          nodeParameters, belugaParameters})
    for (auto& one : part()) all.push_back(std::move(one));
  return all;
}

/// Nav2's names of a robot that moves in any direction, older ones and Beluga's.
bool isOmni(std::string_view model) {
  return model == "nav2_amcl::OmniMotionModel" || model == "omnidirectional" ||
         model == "omnidirectional_drive";
}
bool isDifferential(std::string_view model) {
  return model == "nav2_amcl::DifferentialMotionModel" || model == "differential" ||
         model == "differential_drive";
}

/// Parameters that any node may have, and that are for others than it.
bool isForRos(std::string_view name) { return name.starts_with("qos_overrides."); }

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

const char* typeName(const AmclParameters::Value& value) {
  constexpr std::array kNames = {"true or false", "a whole number", "a number", "a text"};
  return kNames.at(value.index());
}

/// A number or text as the type of @p like, where a whole number is a number, too.
AmclParameters::Value converted(const AmclParameters::Value& value,
                                const AmclParameters::Value& like) {
  const auto* const whole = std::get_if<std::int64_t>(&value);
  if (whole != nullptr && std::holds_alternative<double>(like)) return static_cast<double>(*whole);
  return value;
}

[[noreturn]] void refuseUnknown(const std::string& name) {
  std::string nearest;
  const std::string head = name.substr(0, name.find_first_of("_."));
  for (const auto& known : AmclParameters::all())
    if (known.name.starts_with(head))
      nearest += (nearest.empty() ? "" : ", ") + std::string(known.name);
  throw std::invalid_argument("parameter '" + name + "': amcl has none of that name" +
                              (nearest.empty() ? "" : "; similar ones are " + nearest));
}

}  // namespace

AmclParameters::AmclParameters() {
  for (const Description& one : all()) values_.emplace(one.name, one.byDefault);
}

const std::vector<AmclParameters::Description>& AmclParameters::all() {
  static const std::vector<Description> kAll = [] {
    auto made = table();
    std::sort(made.begin(), made.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return made;
  }();
  return kAll;
}

const AmclParameters::Description* AmclParameters::find(std::string_view name) {
  const auto found =
      std::lower_bound(all().begin(), all().end(), name,
                       [](const auto& one, auto wanted) { return one.name < wanted; });
  return found != all().end() && found->name == name ? &*found : nullptr;
}

void AmclParameters::setText(const std::string& name, const std::string& yaml) {
  if (isForRos(name)) return;
  const Description* const known = find(name);
  if (known == nullptr) refuseUnknown(name);
  YAML::Node node;
  try {
    node = YAML::Load(yaml);
  } catch (const YAML::Exception&) {
    node = YAML::Node(yaml);
  }
  const bool isText = std::holds_alternative<std::string>(known->byDefault);
  Value value = yaml;
  bool flag = false;
  std::int64_t whole = 0;
  double number = 0.0;
  if (isText && node.IsScalar())
    value = node.as<std::string>();
  else if (YAML::convert<bool>::decode(node, flag))
    value = flag;
  else if (YAML::convert<std::int64_t>::decode(node, whole))
    value = whole;
  else if (YAML::convert<double>::decode(node, number))
    value = number;
  else if (!node.IsScalar())
    throw std::invalid_argument("parameter '" + name + "': found " + yaml.substr(0, 60) +
                                ", expected " + typeName(known->byDefault));
  set(name, value);
}

void AmclParameters::check(const std::string& name, const Value& value) {
  const Description* const known = find(name);
  if (known == nullptr) refuseUnknown(name);
  const Value fitting = converted(value, known->byDefault);
  const std::string where = "parameter '" + name + "': ";
  if (fitting.index() != known->byDefault.index())
    throw std::invalid_argument(where + "found " + typeName(value) + ", expected " +
                                typeName(known->byDefault));
  if (const auto* const text = std::get_if<std::string>(&fitting)) {
    constexpr std::size_t kLongest = 4096;
    if (text->size() > kLongest || text->find_first_of(std::string("\n\r\0", 3)) != text->npos)
      throw std::invalid_argument(where +
                                  "found a text of several lines or of more than 4096 "
                                  "bytes, expected a name");
    if (name == "robot_model_type" && !isOmni(*text) && !isDifferential(*text))
      throw std::invalid_argument(where + "is '" + *text +
                                  "', expected nav2_amcl::DifferentialMotionModel or "
                                  "nav2_amcl::OmniMotionModel");
    return;
  }
  if (std::holds_alternative<bool>(fitting)) return;
  const double number = std::holds_alternative<double>(fitting)
                            ? std::get<double>(fitting)
                            : static_cast<double>(std::get<std::int64_t>(fitting));
  if (number >= known->least && number <= known->most) return;
  std::ostringstream why;
  why << where << "is " << number << ", expected " << known->least << " to " << known->most;
  throw std::invalid_argument(why.str());
}

void AmclParameters::set(const std::string& name, const Value& value) {
  check(name, value);
  values_.find(name)->second = converted(value, find(name)->byDefault);
  if (std::find(given_.begin(), given_.end(), name) == given_.end()) given_.push_back(name);
}

const AmclParameters::Value& AmclParameters::get(std::string_view name) const {
  return values_.find(name)->second;
}

double AmclParameters::number(std::string_view name) const {
  const Value& value = get(name);
  const auto* const whole = std::get_if<std::int64_t>(&value);
  return whole != nullptr ? static_cast<double>(*whole) : std::get<double>(value);
}

/// Whether a parameter says something about this robot, since it is not amcl's default.
bool AmclParameters::isOwn(std::string_view name) const {
  return get(name) != find(name)->byDefault;
}

std::string AmclParameters::mclToml() const {
  std::string keys;
  const auto add = [&](std::string_view name, const char* key, double value) {
    if (isOwn(name)) keys += std::string(key) + " = " + tomlNumber(value) + "\n";
  };
  // As in amcl, the least number counts if it is more than the greatest.
  const double least = number("min_particles");
  double greatest = isOwn("max_particles") ? number("max_particles")
                                           : static_cast<double>(MclConfig().maxSamples);
  if (isOwn("min_particles")) greatest = std::max(greatest, least);
  if (isOwn("max_particles") || isOwn("min_particles"))
    keys += "particles = " + std::to_string(std::lround(greatest)) + "\n";
  if (isOwn("min_particles"))
    keys += "min_particles = " + std::to_string(std::lround(least)) + "\n";
  add("pf_err", "kld_error", number("pf_err"));
  add("pf_z", "kld_quantile", number("pf_z"));
  add("update_min_d", "min_distance_m", number("update_min_d"));
  add("update_min_a", "min_rotation_deg", number("update_min_a") / kDegree);
  return keys.empty() ? "" : "\n[mcl]\n" + keys;
}

/// amcl draws noise once an update: its variance after a way of 1 m is alpha times the squared
/// length of a step, times the number of steps, so alpha times the length of a step.
std::string AmclParameters::motionToml() const {
  std::string keys;
  const auto add = [&](std::string_view alpha, const char* key, std::string_view step) {
    constexpr double kLeastStep = 0.01;
    if (isOwn(alpha))
      keys += std::string(key) + " = " +
              tomlNumber(std::sqrt(number(alpha) * std::max(number(step), kLeastStep))) + "\n";
  };
  const bool omni = isOmni(text("robot_model_type"));
  add(omni ? "alpha4" : "alpha1", "turn_per_turn", "update_min_a");
  add("alpha2", "turn_per_m", "update_min_d");
  add("alpha3", "way_per_m", "update_min_d");
  add(omni ? "alpha1" : "alpha4", "way_per_turn", "update_min_a");
  if (keys.empty() && !omni) return "";
  return "\n[motion]\nplugin = \"" + std::string(omni ? "omni" : "odometry") + "\"\n" + keys;
}

AmclSettings AmclParameters::settings() const {
  AmclSettings s;
  s.base = text("base_frame_id");
  s.odom = text("odom_frame_id");
  s.map = text("global_frame_id");
  s.scanTopic = text("scan_topic");
  s.mapTopic = text("map_topic");
  s.isFirstMapOnly = flag("first_map_only");
  s.tellsTransform = flag("tf_broadcast");
  s.transformTolerance = number("transform_tolerance");
  if (flag("set_initial_pose"))
    s.initialPose = Pose2{number("initial_pose.x"), number("initial_pose.y"),
                          wrapAngle(number("initial_pose.yaw"))};
  s.alwaysResets = flag("always_reset_initial_pose");
  // The file of amcl is another one than ours, which must not take its place.
  if (flag("initialize_at_saved_pose") && !text("saved_pose_filepath").empty())
    s.belief = text("saved_pose_filepath") + ".belief";
  if (const double rate = number("save_pose_rate"); isOwn("save_pose_rate"))
    s.saveSeconds = rate > 0.0 ? 1.0 / rate : std::numeric_limits<double>::infinity();
  if (const double seed = number("random_seed"); seed >= 0.0)
    s.seed = static_cast<std::uint64_t>(seed);
  if (isOwn("laser_max_range")) s.maxRange = std::max(number("laser_max_range"), 0.0);
  s.startsItself = flag("autostart_node");
  s.heartbeatSeconds = number("bond_heartbeat_period");
  s.robotToml = mclToml() + motionToml();
  return s;
}

std::string AmclParameters::remark(bool hasRobotFile) const {
  std::map<std::string, std::vector<std::string>> why;
  for (const std::string& name : given_) {
    const Description& known = *find(name);
    const bool isOfRobot =
        known.leavesDefault || name == "robot_model_type" || name == "laser_max_range";
    if (known.kind == Kind::kNone)
      why[std::string(known.effect)].push_back(name);
    else if (hasRobotFile && isOfRobot && name != "save_pose_rate")
      why["the robot file tells it"].push_back(name);
    else if (known.leavesDefault && !isOwn(name))
      why["it has amcl's default, so Ortung's own stays"].push_back(name);
  }
  std::string all;
  for (const auto& [reason, names] : why)
    all += (all.empty() ? "without effect: " : "; ") + joined(names) + " (" + reason + ")";
  return all;
}

}  // namespace ortung::ros2
