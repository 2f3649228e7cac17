// What a camera's picture costs, beside what OpenGL alone takes for as many pixels. All of it
// happens in the calling thread, so the column CPU is what counts on a machine that does other
// things, too.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "ortung/base/Angles.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/pictures/CameraPicture.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung {
namespace {

/// The field with ten robots and a ball on it.
std::unique_ptr<SimWorld> match() {
  auto world = readWorld(ORTUNG_MAPS "/fields/msl.toml");
  for (const Primitive& one : world->movables())
    world->addBody({one.kind, one.name, one.colour, {inOwnFrame(one)}}, {1.5, 0.3, 0.0});
  const RobotConfig robot = readRobot(std::filesystem::path(ORTUNG_MAPS "/robots/msl_omni.toml"));
  const RobotShape shape = RobotShape::read(robot);
  for (int i = 0; i < 10; ++i) {
    const double angle = kTurn * i / 10.0;
    const double distance = 1.6 + 0.5 * i;
    const RobotNumber number =
        world->addBody({"robot", "robot" + std::to_string(i), "black", shape.pieces},
                       {distance * std::cos(angle), distance * std::sin(angle), angle});
    world->markBody(number, i % 2 == 0 ? "cyan" : "magenta");
  }
  return world;
}

/// Nothing but a floor.
std::unique_ptr<SimWorld> nothing() {
  const auto file = std::filesystem::temp_directory_path() / "ortung-camera-bench.toml";
  writeFile(file,
            "[world]\nx_m = [-12, 12]\ny_m = [-8, 8]\n[[landmark]]\nkind = \"none\"\n"
            "identity = 1\nposition_m = [0, 0]\n");
  auto world = readWorld(file);
  std::filesystem::remove(file);
  return world;
}

CameraView cameraOf(const std::string& robotFile) {
  const RobotConfig robot = readRobot(std::filesystem::path(ORTUNG_MAPS "/robots/" + robotFile));
  for (const SensorConfig& sensor : robot.sensors)
    if (sensor.plugin == "camera")
      return readCameraView(sensor.parameters.table("camera"),
                            sensor.parameters.table("pose").number("z_m"));
  throw std::runtime_error(robotFile + ": has no camera");
}

constexpr Pose2 kHere{-1.0, -0.7, 0.3};

/// What OpenGL alone takes: an even floor on one face of as many pixels, and reading it back.
void bareOpenGl(benchmark::State& state) {
  const auto world = nothing();
  const CameraView view = cameraOf("msl_front_camera.toml");
  Drawing drawing;
  drawing.camera = cameraPoseOf(view, kHere);
  SheetFace face;
  face.width = drawing.width = static_cast<int>(state.range(0));
  face.height = drawing.height = static_cast<int>(state.range(1));
  drawing.faces = {&face, 1};
  std::vector<std::uint32_t> colours(static_cast<std::size_t>(face.width * face.height));
  Sheet sheet;
  sheet.colours = colours;
  for (auto _ : state) world->draw(drawing, sheet);
  state.counters["pixels/s"] = benchmark::Counter(static_cast<double>(colours.size()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void picture(benchmark::State& state, const std::string& robot, double variation) {
  const auto world = match();
  CameraPicture camera(cameraOf(robot), {.strength = variation, .seed = 3});
  std::vector<std::uint32_t> words;
  std::uint64_t stream = 0;
  for (auto _ : state) camera.take(*world, kHere, 0, CameraPicture::Noise{1, ++stream}, words);
  const ImageSize sheet = camera.sheet().size();
  state.counters["faces"] = static_cast<double>(camera.sheet().faces().size());
  state.counters["sheet"] = static_cast<double>(sheet.width) * sheet.height;
}

void annotations(benchmark::State& state, const std::string& robot) {
  const auto world = match();
  CameraPicture camera(cameraOf(robot));
  const ImageSize size = camera.camera().model().size();
  std::vector<std::uint32_t> things(static_cast<std::size_t>(size.width * size.height));
  std::vector<float> ranges(things.size());
  for (auto _ : state) camera.annotate(*world, kHere, 0, things, ranges);
}

BENCHMARK(bareOpenGl)->Args({640, 480})->Args({480, 480})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, perspective, "msl_front_camera.toml", 0.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, omnidirectional, "msl_camera.toml", 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, fisheye608x800, "msl_four_cameras.toml", 0.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, perspectiveVaried, "msl_front_camera.toml", 1.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, omnidirectionalVaried, "msl_camera.toml", 1.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(annotations, perspective, "msl_front_camera.toml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(annotations, omnidirectional, "msl_camera.toml")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ortung

BENCHMARK_MAIN();
