#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/ConeData.hpp"

using namespace ortung;

TEST(Sonar, IsRightInARoom) {
  // the block
}
