#pragma once

#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::testing {

/// Five floors of one building, drawn by chance: the same outer walls, corridor, lift and columns
/// of rooms on all floors, while doors, some partitions and furniture differ, as in an office
/// building. The corridor runs along x from 0 to 30 m, from y = 7 to 9.4 m; the lift is south of
/// its middle and opens to it.
struct DrawnBuilding {
  static constexpr std::array kFloors{"g", "f1", "f2", "f3", "f4"};
  static constexpr Pose2 kLift{15.0, 5.9, 1.5707963267948966};  ///< faces the door
  static constexpr double kCorridor = 8.2;                      ///< y of its middle [m]

  /// @param twins whether the last two floors are the same
  explicit DrawnBuilding(std::uint64_t seed, bool twins = false) : seed_(seed), twins_(twins) {}

  /// Returns the world file, without lifts.
  std::string toml() const {
    std::string text = "[world]\nname = \"building\"\n";
    for (std::size_t i = 0; i < kFloors.size(); ++i) {
      text += std::string("\n[[floor]]\nname = \"") + kFloors[i] + "\"\n";
      text += floor(kFloors[i], twins_ && i + 1 == kFloors.size() ? i - 1 : i);
    }
    return text;
  }

 private:
  struct Drawing {
    std::string floor;
    std::ostringstream text;

    void box(double xLow, double xHigh, double yLow, double yHigh) {
      if (xHigh - xLow < 0.02 || yHigh - yLow < 0.02) return;
      text << "\n[[rectangle]]\nkind = \"wall\"\nfloor = \"" << floor << "\"\ncenter_m = ["
           << (xLow + xHigh) / 2 << ", " << (yLow + yHigh) / 2 << "]\nsize_m = [" << xHigh - xLow
           << ", " << yHigh - yLow << "]\n";
    }
    /// A wall along x with openings of 1 m around some places, in their order.
    void wallAlongX(double y, double from, double to, const std::vector<double>& doors) {
      for (const double door : doors) {
        box(from, door - 0.5, y - 0.07, y + 0.07);
        from = door + 0.5;
      }
      box(from, to, y - 0.07, y + 0.07);
    }
  };

  /// Draws the rooms between two walls along x. @param yDoors y of the wall to the corridor
  static void rooms(Drawing& drawing, Random& random, double yLow, double yHigh, double yDoors,
                    double xLow, double xHigh, int count) {
    const double width = (xHigh - xLow) / count;
    std::vector<double> doors;
    for (int i = 0; i < count; ++i) {
      const double left = xLow + i * width;
      if (i > 0 && random.uniform() < 0.75) drawing.box(left - 0.05, left + 0.05, yLow, yHigh);
      if (random.uniform() < 0.8) doors.push_back(left + random.uniform(0.8, width - 0.8));
      const auto things = 2 + random.below(3);
      for (std::uint64_t k = 0; k < things; ++k) {
        const double x = left + random.uniform(0.6, width - 0.6);
        const double y = random.uniform(yLow + 0.5, yHigh - 0.5);
        drawing.box(x, x + random.uniform(0.3, 0.9), y, y + random.uniform(0.3, 0.9));
      }
    }
    drawing.wallAlongX(yDoors, xLow, xHigh, doors);
  }

  std::string floor(const std::string& name, std::size_t number) const {
    Drawing drawing{name, {}};
    Random random(seed_, number);
    drawing.box(-0.2, 30.2, -0.2, 0.0);
    drawing.box(-0.2, 30.2, 16.0, 16.2);
    drawing.box(-0.2, 0.0, -0.2, 16.2);
    drawing.box(30.0, 30.2, -0.2, 16.2);
    rooms(drawing, random, 9.47, 16.0, 9.4, 0.0, 30.0, 7);
    rooms(drawing, random, 0.0, 6.93, 7.0, 0.0, 13.9, 3);
    rooms(drawing, random, 0.0, 6.93, 7.0, 16.1, 30.0, 3);
    // The cabin, 2 m by 2 m, and its shaft.
    drawing.box(13.9, 14.0, 0.0, 7.07);
    drawing.box(16.0, 16.1, 0.0, 7.07);
    drawing.box(14.0, 16.0, 4.8, 4.9);
    drawing.box(14.0, 14.4, 6.93, 7.07);
    drawing.box(15.6, 16.0, 6.93, 7.07);
    return drawing.text.str();
  }

  std::uint64_t seed_;
  bool twins_;
};

/// A robot with a lidar that looks all around.
inline constexpr const char* kRoundRobot = R"([robot]
name = "round"
radius_m = 0.25

[[sensor]]
plugin = "odometry"
period_s = 0.05

[[sensor]]
plugin = "lrf"
model = "lidar"
type = "LRF"
feature = "scan"
pose = { x_m = 0.0, y_m = 0.0, z_m = 0.3, theta_deg = 0 }
beams = 240
first_angle_deg = -180
angle_step_deg = 1.5
max_range_m = 12.0
period_s = 0.2
perception = "endpoints"
sigma_m = 0.05
sigma_per_m = 0.0
outliers = 0.2
)";

}  // namespace ortung::testing
