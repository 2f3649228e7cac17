// Where a localization starts, as Python says it.
#include "Starts.hpp"

#include <array>

#include "ortung/base/Pose2.hpp"

namespace ortung::python {

LocalizationStart startOf(const py::object& start) {
  LocalizationStart result;
  if (py::isinstance<py::str>(start)) {
    const auto kind = py::cast<std::string>(start);
    if (kind == "truth") result.kind = LocalizationStart::Kind::kTruth;
    if (kind != "truth" && kind != "global")
      throw py::value_error("start is '" + kind + "', expected 'global', 'truth' or (x, y, theta)");
    return result;
  }
  const auto pose = py::cast<std::array<double, 3>>(start);
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

}  // namespace ortung::python
