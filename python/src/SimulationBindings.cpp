// Simulations that Python steps, with robots that it commands.
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Robots.hpp"
#include "Worlds.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/SceneRun.hpp"
#include "ortung/sim/TableStore.hpp"

namespace ortung::python {
namespace {

struct SharedRun;

/// A robot of a simulation. It is found by its number, since it may leave the field.
struct RunRobot {
  std::shared_ptr<SharedRun> run;
  RobotNumber number = 0;
};

/// A simulation, and Python's threads at it.
struct SharedRun : std::enable_shared_from_this<SharedRun> {
  PluginFactory factory{PluginFactory::standardFolders()};
  Scene scene;
  std::unique_ptr<SceneRun> run;
  struct Playing {
    RobotNumber robot = 0;
    py::object player;
  };
  std::vector<Playing> players;  ///< players of Python, in the order in which they act
  std::vector<std::string> problems;
  std::uint64_t added = 0;
  std::shared_ptr<Gate> gate = std::make_shared<Gate>("this Simulation");

  ~SharedRun() {
    if (gate->isBroken()) leave(run);
  }
  Simulation& simulation() { return run->simulation(); }
};
using Run = std::shared_ptr<SharedRun>;

SimRobot& need(const RunRobot& self) {
  SimRobot* found = self.run->simulation().find(self.number);
  if (found == nullptr)
    throw std::runtime_error("robot " + std::to_string(self.number) + " has left the field");
  return *found;
}

/// Calls work(SimRobot&) alone.
template <class Work>
auto command(const RunRobot& self, const Work& work) {
  return alone(*self.run->gate, [&] { return work(need(self)); });
}

std::optional<Pose2> poseOf(const py::object& start) {
  if (start.is_none()) return std::nullopt;
  const auto numbers = py::cast<std::array<double, 3>>(start);
  for (const double one : numbers)
    if (!std::isfinite(one))
      throw py::value_error("a pose must be finite: x, y [m], heading [rad]");
  return Pose2{numbers[0], numbers[1], wrapAngle(numbers[2])};
}

Run open(const std::filesystem::path& file, std::uint64_t seed, bool noise,
         std::optional<double> cycle, unsigned threads) {
  const auto made = std::make_shared<SharedRun>();
  Simulation::Config config;
  config.seed = seed;
  config.noise = noise;
  config.cycle = cycle;
  config.threads = threads;
  SharedRun* const self = made.get();
  config.onProblem = [self](const std::string& what) { self->problems.push_back(what); };
  PlayerControl::Config players;
  players.onProblem = config.onProblem;
  const py::gil_scoped_release others;
  made->scene = Scene::open(file);
  players.tables = std::make_shared<TableStore>(made->scene.world);
  made->run = std::make_unique<SceneRun>(made->scene, config, made->factory, players);
  return made;
}

std::vector<RunRobot> robotsOf(const Run& self) {
  const Gate::Alone visit(*self->gate);
  std::vector<RunRobot> all;
  for (const auto& robot : self->simulation().robots())
    all.push_back({self, robot->state().number});
  return all;
}

RunRobot addRobot(const Run& self, const std::filesystem::path& file, const py::object& start,
                  const std::string& name) {
  const std::optional<Pose2> pose = poseOf(start);
  return alone(*self->gate, [&] {
    RobotConfig config = readRobot(file);
    if (!name.empty()) config.name = name;
    const std::uint64_t number = self->run->entrants() + self->added;
    SimRobot& robot = self->run->addRobot(config, self->factory, pose, number);
    ++self->added;
    return RunRobot{self, robot.state().number};
  });
}

/// Lets Python's players act: each gets its robot, and ends by returning False.
void actOf(const Run& self) {
  std::vector<SharedRun::Playing> going;
  const std::vector<SharedRun::Playing> playing = std::exchange(self->players, {});
  std::exception_ptr failure;
  for (const SharedRun::Playing& one : playing) {
    if (failure || self->simulation().find(one.robot) == nullptr) continue;
    try {
      const py::object answer = one.player.attr("sense_and_act")(RunRobot{self, one.robot});
      if (!answer.is(py::bool_(false))) going.push_back(one);
    } catch (...) {
      failure = std::current_exception();
    }
  }
  // A player may have added others.
  self->players.insert(self->players.begin(), going.begin(), going.end());
  if (failure) std::rethrow_exception(failure);
}

/// One cycle. A player that raises is stopped, and so is stepping, after the cycle.
void stepOnce(const Run& self) {
  alone(*self->gate, [&] { self->run->act(); });
  std::exception_ptr failure;
  try {
    actOf(self);
  } catch (...) {
    failure = std::current_exception();
  }
  alone(*self->gate, [&] {
    self->run->move();
    self->run->players().deliver();
  });
  if (failure) std::rethrow_exception(failure);
}

void step(const Run& self, std::size_t cycles) {
  for (std::size_t i = 0; i < cycles; ++i) {
    stepOnce(self);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

py::list readingsOf(const RunRobot& self) {
  const Gate::Alone visit(*self.run->gate);
  need(self);
  py::list all;
  for (const Message& one : std::as_const(self.run->simulation()).readingsOf(self.number))
    all.append(py::make_tuple(one.stamp, toText(one.id), copyOf(one.words)));
  return all;
}

Container containerOf(const RunRobot& self) {
  const Gate::Alone visit(*self.run->gate);
  SimRobot& robot = need(self);
  for (const PlayerControl::Seated& one : self.run->run->players().players())
    if (one.robot == robot.config().name && !one.isGuest)
      throw std::runtime_error(one.robot + " leaves the field with its player " + one.plugin +
                               ", so its container can't be kept; add_robot() adds one that stays");
  return {self.run, &robot.container(), self.run->gate};
}

void play(const RunRobot& self, const py::object& player) {
  if (py::hasattr(player, "sense_and_act")) {
    need(self);
    self.run->players.push_back({self.number, player});
    return;
  }
  if (!py::isinstance<py::str>(player))
    throw py::type_error("the player is " + py::cast<std::string>(py::repr(py::type::of(player))) +
                         ", expected an object with sense_and_act(robot), or a text as "
                         "'goalkeeper:policy=blocking'");
  const PlayerWish wish = parsePlayer(py::cast<std::string>(player));
  command(self, [&](SimRobot& robot) {
    self.run->run->players().lead(
        robot, wish, self.run->simulation().random((std::uint64_t{1} << 40) + self.number));
  });
}

py::list thingsOf(const Run& self) {
  const Gate::Alone visit(*self->gate);
  py::list all;
  for (const Simulation::Thing& one : self->simulation().things()) {
    py::dict thing;
    thing["name"] = one.name;
    thing["kind"] = one.kind;
    thing["pose"] = tupleOf(one.pose);
    thing["velocity"] = py::make_tuple(one.velocity.x, one.velocity.y, one.velocity.theta);
    all.append(thing);
  }
  return all;
}

void placeThing(const Run& self, const std::string& name, const py::object& pose,
                const std::array<double, 3>& velocity) {
  const std::optional<Pose2> place = poseOf(pose);
  if (!place) throw py::type_error("pose is None, expected (x, y, heading)");
  alone(*self->gate, [&] {
    const auto things = self->simulation().things();
    for (std::size_t i = 0; i < things.size(); ++i)
      if (things[i].name == name)
        return self->simulation().placeThing(i, *place, {velocity[0], velocity[1], velocity[2]});
    throw py::key_error("there is no thing '" + name + "' in this world");
  });
}

std::string reprOf(const RunRobot& self) {
  const Gate::Alone visit(*self.run->gate);
  const SimRobot* robot = self.run->simulation().find(self.number);
  if (robot == nullptr) return "SimulatedRobot(has left the field)";
  const Pose2& pose = robot->state().pose;
  char text[120];
  std::snprintf(text, sizeof text, "', x=%.3f, y=%.3f, theta=%.4f)", pose.x, pose.y, pose.theta);
  return "SimulatedRobot('" + robot->config().name + text;
}

std::string reprOf(const Run& self) {
  const Gate::Alone visit(*self->gate);
  char text[120];
  std::snprintf(text, sizeof text, "', now=%.3f s, %zu robots)",
                toSeconds(self->simulation().now()), self->simulation().robots().size());
  return "Simulation('" + self->simulation().world().name() + text;
}

using PyRobot = py::class_<RunRobot>;

void bindCommands(PyRobot& robot) {
  robot
      .def(
          "drive",
          [](const RunRobot& self, double forward, double turn) {
            command(self, [&](SimRobot& one) {
              one.setTranslationalVelocity(forward);
              one.setRotationalVelocity(turn);
            });
          },
          py::arg("forward"), py::arg("turn") = 0.0,
          "Drives forwards [m/s] and turns to the left [rad/s] until the next command, within the "
          "robot's limits.")
      .def(
          "set_motion",
          [](const RunRobot& self, const std::vector<double>& numbers) {
            command(self, [&](SimRobot& one) { one.setMotion(numbers); });
          },
          py::arg("numbers"),
          "Sets the command vector of its kind of motion, e.g. speeds of wheels.")
      .def(
          "set_manipulator",
          [](const RunRobot& self, const std::string& manipulator, const std::string& state) {
            command(self, [&](SimRobot& one) { one.setManipulator(manipulator, state); });
          },
          py::arg("manipulator"), py::arg("state"),
          "Brings a manipulator, e.g. a kicker, into a state.")
      .def(
          "place",
          [](const RunRobot& self, double x, double y, double theta) {
            const Pose2 pose = *poseOf(py::make_tuple(x, y, theta));
            command(self, [&](SimRobot& one) { self.run->simulation().place(one, pose); });
          },
          py::arg("x"), py::arg("y"), py::arg("theta"),
          "Puts the robot at another pose [m, rad], unnoticed by its odometry. ValueError if it "
          "does not fit there.")
      .def(
          "wander",
          [](const RunRobot& self, std::optional<double> speed) {
            command(self,
                    [&](SimRobot& one) { self.run->run->letWander(one, self.number, speed); });
          },
          py::arg("speed") = py::none(),
          "Lets it drive to random places until its first command, at this speed at most [m/s].")
      .def("play", &play, py::arg("player"),
           "Lets a player drive the robot: an object whose sense_and_act(robot) is called in each "
           "cycle, once all have sensed, until it returns False; or a plugin by its text, "
           "'goalkeeper:policy=blocking'.");
}

void bindRobot(py::module_& module) {
  PyRobot robot(module, "SimulatedRobot",
                "A robot of a simulation: its true state, its readings, its commands.");
  robot
      .def_property_readonly(
          "name",
          [](const RunRobot& self) {
            const Gate::Alone visit(*self.run->gate);
            return need(self).config().name;
          },
          "Its name, which no other robot of the simulation has.")
      .def_property_readonly(
          "pose",
          [](const RunRobot& self) {
            const Gate::Alone visit(*self.run->gate);
            return tupleOf(need(self).state().pose);
          },
          "The true pose in the field: x, y [m], heading [rad].")
      .def_property_readonly(
          "velocity",
          [](const RunRobot& self) {
            const Gate::Alone visit(*self.run->gate);
            const Twist& its = need(self).state().velocity;
            return py::make_tuple(its.x, its.y, its.theta);
          },
          "The true velocity in the field: x, y [m/s], turn [rad/s].")
      .def_property_readonly("container", &containerOf, "Its features with their newest readings.")
      .def_property_readonly("readings", &readingsOf,
                             "The readings of the last cycle, as readings() gives them: (stamp "
                             "[us], 'model/type/feature', words).")
      .def("__repr__", [](const RunRobot& self) { return reprOf(self); });
  bindCommands(robot);
}

}  // namespace

void bindSimulations(py::module_& module) {
  bindRobot(module);
  py::class_<SharedRun, Run>(
      module, "Simulation",
      "A world with robots that move in it, in cycles of fixed length. The same seed and the same "
      "commands give the same bits.")
      .def(py::init(&open), py::arg("file"), py::arg("seed") = 1, py::arg("noise") = true,
           py::arg("cycle") = py::none(), py::arg("threads") = 1,
           "file: of a world, or of a scene with robots; noise: whether sensors and wheels have "
           "errors; cycle: its length [s], None for the world's; threads: which sense.")
      .def("add_robot", &addRobot, py::arg("robot"), py::arg("start") = py::none(),
           py::arg("name") = "",
           "Adds a robot of a file at a pose (x, y, theta) [m, rad], or a random one, and returns "
           "it. ValueError if there is no room, or another robot has its name.")
      .def("step", &step, py::arg("cycles") = 1,
           "Simulates so many cycles: all robots sense, players act, everything moves.")
      .def_property_readonly("robots", &robotsOf, "All robots, in the order they came.")
      .def_property_readonly("things", &thingsOf,
                             "What moves besides: name, kind, pose (x, y, heading) and velocity.")
      .def("place_thing", &placeThing, py::arg("name"), py::arg("pose"),
           py::arg("velocity") = std::array{0.0, 0.0, 0.0},
           "Puts a thing at a pose with a velocity in the field [m, rad, m/s, rad/s].")
      .def_property_readonly(
          "now",
          [](const Run& self) {
            const Gate::Alone visit(*self->gate);
            return self->simulation().now();
          },
          "The time of the next cycle [us].")
      .def_property_readonly(
          "cycle", [](const Run& self) { return self->simulation().cycle(); },
          "Length of a cycle [s].")
      .def_property_readonly(
          "world",
          [](const Run& self) {
            const Gate::Alone visit(*self->gate);
            return SharedWorld{self->scene.world, self->simulation().world().another()};
          },
          "The world without what moves.")
      .def_property_readonly(
          "problems",
          [](const Run& self) {
            const Gate::Alone visit(*self->gate);
            return self->problems;
          },
          "What plugins of robots have done wrong, and why players were stopped.")
      .def("__repr__", [](const Run& self) { return reprOf(self); });
}

}  // namespace ortung::python
