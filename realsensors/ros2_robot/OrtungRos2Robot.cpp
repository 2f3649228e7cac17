/// ortung-ros2-robot: a robot of a message board, i.e. one that is simulated, replayed or really
/// there, as a robot of ROS 2: it tells clock, scans, ranges, odometry, frames and map, and obeys
/// cmd_vel.

#include <CLI/CLI.hpp>
#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "Participant.hpp"
#include "RobotNode.hpp"
#include "RosArguments.hpp"
#include "StartPose.hpp"
#include "VelocityCommand.hpp"
#include "ortung/client/RobotSession.hpp"

namespace {

using ortung::RobotSession;
using ortung::SessionOptions;
using ortung::Timestamp;
using ortung::ros2::Participant;
using ortung::ros2::Qos;
using ortung::ros2::RobotNode;
using ortung::ros2::RobotTopics;
using ortung::ros2::RosArguments;
using ortung::ros2::VelocityCommand;

std::atomic<bool> isStopped = false;

void onSignal(int) { isStopped = true; }

/// What the command line says.
struct Arguments {
  SessionOptions session;
  Participant::Options node;
  RobotNode::Options robot;
  std::string server = "127.0.0.1:7777";
  std::filesystem::path robotFile, tokenFile;
  std::string start;
  double speed = -1.0;  ///< times real time; less than 0: as the server has it
  double rate = 100.0;  ///< how often the server is asked [1/s]
  std::string command = "cmd_vel";
  bool isStamped = false;
  double patience = 0.5;  ///< [s]
  double mostForward = std::numeric_limits<double>::infinity();
  double mostTurn = std::numeric_limits<double>::infinity();
  std::string distro = ortung::ros2::releaseHere(), mapFrame = "none";
};

void addServer(CLI::App& app, Arguments& a) {
  app.add_option("--connect", a.server, "HOST:PORT of the server")->capture_default_str();
  app.add_option("--robot", a.robotFile,
                 "Robot file (TOML) of the robot; not needed for one that is really there");
  app.add_option("--start", a.start, "Its pose in a simulation: x,y,degrees; default: anywhere");
  app.add_option("--name", a.session.name, "Name of the robot at the server")
      ->capture_default_str();
  app.add_option("--token-file", a.tokenFile, "File with the token of that name, if it needs one");
  app.add_option("--features", a.robot.features,
                 "MODEL/TYPE/FEATURE of readings to tell, each part may be *; may be given again")
      ->capture_default_str();
  app.add_option("--real-time-factor", a.speed,
                 "Sets the speed of the simulation; needs --allow-control NAME at the server")
      ->check(CLI::Range(0.001, 1000.0));
  app.add_option("--rate", a.rate, "How often the server is asked, and the clock told [1/s]")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
}

void addNode(CLI::App& app, Arguments& a) {
  app.add_option("--node", a.node.names.node, "Name of the node")->capture_default_str();
  app.add_option("--namespace", a.node.names.space, "Namespace of node and topics, as /robot1")
      ->capture_default_str();
  app.add_option("--frame-prefix", a.robot.framePrefix,
                 "What the robot's frames begin with; then /tf, /tf_static and /map are not in the "
                 "namespace");
  app.add_option("--base-frame", a.robot.base, "Frame of the robot")->capture_default_str();
  app.add_option("--odom-frame", a.robot.odom, "Frame of odometry")->capture_default_str();
  app.add_option("--map-frame-from", a.mapFrame,
                 "What tells map -> odom: none, truth, or the robot's own localization (robot)")
      ->check(CLI::IsMember({"none", "truth", "robot"}))
      ->capture_default_str();
  app.add_flag("--ground-truth", a.robot.tellsTruth, "Tell the true pose at ground_truth");
  app.add_flag("--no-clock{false}", a.robot.tellsClock,
               "Don't tell /clock, e.g. since another robot of the same simulation does");
  app.add_flag("--no-map{false}", a.robot.tellsMap, "Don't tell the map");
  app.add_option("--map-height", a.robot.mapHeight,
                 "The map shows what is so high over the floor [m]")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--cmd-vel", a.command, "Topic of velocities")->capture_default_str();
  app.add_flag("--stamped", a.isStamped, "They are TwistStamped instead of Twist");
  app.add_option("--watchdog", a.patience,
                 "Time without a command after which the robot stops, by its clock [s]")
      ->check(CLI::Range(0.05, 60.0))
      ->capture_default_str();
  app.add_option("--max-linear", a.mostForward,
                 "Greatest velocity [m/s]; default: that of the drive")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--max-angular", a.mostTurn, "Greatest turning [rad/s]; default: likewise")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--distro", a.distro,
                 "Release of those it talks to; default: ROS_DISTRO, or humble")
      ->check(CLI::IsMember(ortung::ros2::kReleases))
      ->capture_default_str();
}

ortung::Pose2 poseOf(const std::string& text) {
  const auto pose = ortung::ros2::parseStartPose(text);
  if (!pose) throw std::runtime_error("--start is '" + text + "', expected x,y,degrees");
  return *pose;
}

void setServer(const std::string& text, SessionOptions& session) {
  const std::size_t colon = text.rfind(':');
  const char* const end = text.data() + text.size();
  const char* const port = colon == text.npos ? end : text.data() + colon + 1;
  const auto [stop, error] = std::from_chars(port, end, session.port);
  if (error != std::errc() || stop != end || colon == 0)
    throw std::runtime_error("--connect is '" + text + "', expected HOST:PORT");
  session.host = text.substr(0, colon);
  if (session.host.starts_with('[') && session.host.ends_with(']'))
    session.host = session.host.substr(1, session.host.size() - 2);
}

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf()))
    throw std::runtime_error(file.string() + ": can't be read, expected a file with a text");
  return text.str();
}

/// The robot, its node, and what goes between them.
class Bridge {
 public:
  explicit Bridge(Arguments& a)
      : a_(a),
        session_(a.session, a.robotFile.empty() ? "" : textOf(a.robotFile)),
        command_(commandOptions()),
        participant_(a.node) {
    if (session_.kind() == "robot") a_.robot.tellsClock = false;  // its time is that of the day
    ortung::ros2::BoardText board;
    session_.ask("DESCRIBE robot", &board.robot);
    session_.ask("DESCRIBE world", &board.world);
    if (a_.robot.tellsMap && session_.kind() == "simulation")
      session_.ask("DESCRIBE field", &board.field);
    if (a_.speed > 0.0) session_.ask("SPEED " + std::to_string(a_.speed));
    node_.emplace(a_.robot, board, participant_);
    participant_.subscribe(
        a_.command, a_.isStamped ? ortung::ros2::TwistStamped::kType : ortung::ros2::Twist::kType,
        Qos::kDefault, [this](std::string_view cdr) {
          a_.isStamped ? command_.takeStamped(cdr) : command_.take(cdr);
        });
  }

  void run() {
    node_->start(now());
    std::cout << "ortung-ros2-robot: " << a_.session.name << " of " << a_.session.server()
              << " in domain " << a_.node.domain << ":";
    const ortung::ros2::RosNames& names = a_.node.names;
    for (const std::string& topic : node_->topics()) std::cout << ' ' << names.resolve(topic);
    std::cout << "; obeys " << names.resolve(a_.command) << '\n' << std::flush;
    const std::chrono::nanoseconds period(static_cast<std::int64_t>(1e9 / a_.rate));
    auto next = std::chrono::steady_clock::now();
    while (!isStopped) {
      turn();
      const auto at = std::chrono::steady_clock::now();
      next = std::max(next + period, at - period);  // what was missed is not made up for
      std::this_thread::sleep_until(next);
    }
    report();
  }

 private:
  VelocityCommand::Options commandOptions() {
    const ortung::RobotDescription robot = session_.describe();
    if (robot.features.empty())
      throw std::runtime_error("the robot senses nothing, expected a robot file with sensors");
    const auto least = [](double wanted, std::optional<double> drive) {
      return std::min(wanted, drive.value_or(std::numeric_limits<double>::infinity()));
    };
    return {least(a_.mostForward, robot.maxTranslationalVelocity),
            least(a_.mostTurn, robot.maxRotationalVelocity),
            static_cast<Timestamp>(a_.patience * 1e6)};
  }
  Timestamp now() {
    const std::string reply = session_.ask("TIME");
    constexpr std::string_view kKey = " received=";
    const std::size_t key = reply.find(kKey);
    Timestamp time = 0;
    if (key != reply.npos)
      std::from_chars(reply.data() + key + kKey.size(), reply.data() + reply.size(), time);
    return time;
  }
  void turn() {
    const Timestamp time = now();
    node_->tell(time, session_.update(node_->queries()));
    if (const auto velocity = command_.due(time)) {
      session_.ask("VELOCITY v_m_s=" + std::to_string(velocity->forward) +
                   " w_rad_s=" + std::to_string(velocity->turn));
    }
    constexpr std::chrono::seconds kReports{10};
    const auto at = std::chrono::steady_clock::now();
    if (at - reported_ < kReports) return;
    reported_ = at;
    report();
  }
  /// Says what has been left out since it was said last.
  void report() {
    const auto say = [this](const std::string& what, std::uint64_t count) {
      std::uint64_t& said = said_[what];
      if (count != said) std::cerr << "ortung-ros2-robot: " << what << ": " << count << " times\n";
      said = count;
    };
    for (const auto& [what, count] : command_.leftOut()) say(a_.command + ": " + what, count);
    for (const auto& [what, count] : node_->leftOut()) say(what, count);
    say("messages that DDS did not take", participant_.dropped());
    session_.takeNews();  // others may talk; nobody listens
  }

  Arguments& a_;
  RobotSession session_;
  VelocityCommand command_;
  Participant participant_;  ///< ends before what its threads use
  std::optional<RobotNode> node_;
  std::chrono::steady_clock::time_point reported_ = std::chrono::steady_clock::now();
  std::map<std::string, std::uint64_t> said_;
};

/// Reads all that the command line says. @throws CLI::ParseError, std::runtime_error,
/// std::invalid_argument
void read(CLI::App& app, Arguments& a, const std::vector<std::string>& words) {
  const RosArguments ros = RosArguments::read(words, a.node.names.node);
  app.parse(std::vector<std::string>(ros.others.rbegin(), ros.others.rend()));
  ortung::ros2::RosNames& names = a.node.names;
  if (ros.namesNode) names.node = ros.names.node;
  if (ros.names.space != "/") names.space = ros.names.space;
  names.remaps = ros.names.remaps;
  names.check();
  setServer(a.server, a.session);
  if (!a.start.empty()) a.session.start = poseOf(a.start);
  if (!a.tokenFile.empty()) std::istringstream(textOf(a.tokenFile)) >> a.session.token;
  a.node.distro = ortung::ros2::distroOf(a.distro);
  a.robot.distro = a.node.distro;
  if (a.mapFrame == "truth") a.robot.mapFrame = RobotTopics::MapFrame::kTruth;
  if (a.mapFrame == "robot") a.robot.mapFrame = RobotTopics::MapFrame::kBest;
  a.node.readEnvironment();
}

/// Waits for a server that is beginning, too. @throws as Bridge
void connect(Arguments& a, std::optional<Bridge>& bridge) {
  constexpr std::chrono::seconds kPatience{10};
  constexpr std::chrono::milliseconds kBetween{200};
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!bridge && !isStopped) {
    try {
      bridge.emplace(a);
    } catch (const ortung::ConnectionLost&) {
      if (std::chrono::steady_clock::now() > end) throw;
      std::this_thread::sleep_for(kBetween);
    } catch (const ortung::ServerRefused&) {
      if (a.robotFile.empty())
        std::cerr << "ortung-ros2-robot: a simulation needs --robot FILE" << '\n';
      throw;
    }
  }
}

int start(const std::vector<std::string>& words) {
  CLI::App app("Makes a robot of a server of ortung (sim, serve, robot) a robot of ROS 2",
               "ortung-ros2-robot");
  app.footer(
      "--ros-args -r FROM:=TO -- is understood as by any node.\n"
      "ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY and ROS_AUTOMATIC_DISCOVERY_RANGE are as in ROS.");
  Arguments a;
  a.session.name = "robot";
  a.session.isBinary = true;
  a.node.names.node = "ortung_robot";
  addServer(app, a);
  addNode(app, a);
  try {
    read(app, a, words);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2-robot: " << error.what() << '\n';
    return 2;
  }
  try {
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
    std::optional<Bridge> bridge;
    connect(a, bridge);
    if (bridge) bridge->run();
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2-robot: " << error.what() << '\n';
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return start({argv + 1, argv + argc});
  } catch (...) {  // what even an error could not be told of
    return 1;
  }
}
