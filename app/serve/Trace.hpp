#pragma once

#include <filesystem>
#include <string>

#include "ortung/base/NewFile.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung::app {

/// Where everything was, as lines of a table, which grows as the simulation goes on.
class Trace {
 public:
  explicit Trace(const std::filesystem::path& file) : file_(file) {}
  void add(const Simulation& simulation);
  void commit();

 private:
  void line(Timestamp now, const std::string& kind, std::string name, const Pose2& pose,
            const Twist& velocity, const std::string& states);

  NewFile file_;
  Timestamp next_ = 0;
  std::string text_ = "time_s,kind,name,x_m,y_m,theta_deg,vx_m_s,vy_m_s,w_deg_s,manipulators\n";
};

}  // namespace ortung::app
