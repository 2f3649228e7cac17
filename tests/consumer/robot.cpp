// A robot program of somebody else: one distance to a post, learned and weighed, and MCL on it.
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "ortung/formats/ScalarData.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/motion/OdometryMotion.hpp"

int main() {
  using namespace ortung;
  FieldRegion region;
  region.grid = {-1.0, -1.0, 0.1, 20, 20};
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;

  SensorContainer container;
  SensorData& post = container.add(std::make_unique<ScalarData>(
      SensorId{"camera", "camera", "post1Distance"}, Pose2{}, ScalarData::Config{}));
  post.beginLearning(region, 0.1);
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    const Pose2 pose{region.grid.centreX(cell), region.grid.centreY(cell), 0.0};
    post.setData(0, ScalarData::encode(std::hypot(3.0 - pose.x, pose.y)));
    post.learnProbability(pose);
  }
  post.endLearning();

  Mcl mcl(MclConfig(), region, std::make_unique<OdometryMotion>());
  mcl.startGlobal();
  container.set({1, post.id(), ScalarData::encode(3.0)});
  int updates = 1;  // a start may take some
  while (!mcl.update(container))
    if (++updates == 100) return 1;
  const double distance = std::hypot(3.0 - mcl.estimate().pose.x, mcl.estimate().pose.y);
  std::printf("%.2f m to the post\n", distance);
  return std::abs(distance - 3.0) < 0.3 ? 0 : 1;
}
