// Where a localization starts, as Python says it.
#include "Starts.hpp"

#include <array>

#include "ortung/base/Pose2.hpp"

namespace ortung::python {
namespace {

constexpr const char* kExpected = ", expected 'global', 'truth' or (x, y, theta)";

/// What was given, in a line.
std::string shown(const py::object& start) {
  constexpr std::size_t kLongest = 60;
  auto text = py::cast<std::string>(py::repr(start));
  if (text.size() <= kLongest) return text;
  return "of the type " + py::cast<std::string>(py::type::of(start).attr("__name__"));
}

}  // namespace

LocalizationStart startOf(const py::object& start) {
  LocalizationStart result;
  if (py::isinstance<py::str>(start)) {
    const auto kind = py::cast<std::string>(start);
    if (kind == "truth") result.kind = LocalizationStart::Kind::kTruth;
    if (kind != "truth" && kind != "global")
      throw py::value_error("start is '" + kind + "'" + kExpected);
    return result;
  }
  std::array<double, 3> pose{};
  try {
    pose = py::cast<std::array<double, 3>>(start);
  } catch (const py::cast_error&) {
    throw py::value_error("start is " + shown(start) + kExpected);
  }
  result.kind = LocalizationStart::Kind::kPose;
  result.pose = {pose[0], pose[1], wrapAngle(pose[2])};
  return result;
}

LocalizationConfig configOf(const std::filesystem::path& robot, const std::filesystem::path& tables,
                            const std::string& source, std::uint64_t seed,
                            std::optional<std::size_t> particles, std::optional<unsigned> threads,
                            const py::object& start) {
  LocalizationConfig config;
  config.robot = robot;
  config.tables = tables;
  config.source = source;
  config.seed = seed;
  config.particles = particles;
  config.threads = threads;
  config.start = startOf(start);
  return config;
}

std::unique_ptr<Localization> localizationOf(LocalizationConfig config, bool anyWorld) {
  config.anyWorld = true;  // the message below names the argument
  auto localization = std::make_unique<Localization>(config);
  if (!anyWorld && !localization->worldMismatch().empty())
    throw WorldMismatch(localization->worldMismatch() +
                        "; learn the tables in the same world, or give any_world=True");
  return localization;
}

}  // namespace ortung::python
