// Devices of several features, or of few words, that repeat themselves.
#include <gtest/gtest.h>

#include "FrozenDevices.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

/// A ring of distances beside another device.
struct Ring {
  explicit Ring(int count) {
    for (int i = 0; i < count; ++i) add("ring", "sonar" + std::to_string(i));
    other = &add("radio", "mast");
  }
  ScalarData& add(const std::string& model, const std::string& feature) {
    auto data = std::make_unique<ScalarData>(SensorId{model, "range", feature}, Pose2{},
                                             ScalarData::Config{});
    ScalarData& kept = *data;
    container.add(std::move(data));
    if (model == "ring") features.push_back(&kept);
    return kept;
  }
  /// The robot comes to (x, 0, theta), where the ring reads, and the other device.
  void reads(double x, const std::vector<std::uint32_t>& words, double theta = 0.0) {
    stamp += 100'000;
    motion.follow(stamp, {{x, 0, theta}, 0.0, 0.0, {}, 0.0});
    for (std::size_t i = 0; i < words.size(); ++i)
      container.set({stamp, features[i]->id(), {words[i]}});
    container.set({stamp, other->id(), {word++}});
    const SensorContainer::ReadLock lock = container.read();
    devices.look(container);
  }
  bool isFrozen() const {
    EXPECT_FALSE(devices.has(*other));
    EXPECT_EQ(devices.first(), devices.has(*features[0]) ? features[0] : nullptr);
    return devices.has(*features[0]);
  }

  SensorContainer container;
  std::vector<SensorData*> features;
  SensorData* other = nullptr;
  OdometryMotion motion;
  MclConfig config;  // 0.05 m
  FrozenDevices devices{config, motion};
  Timestamp stamp = 0;
  std::uint32_t word = 5000;
};

const std::vector<std::uint32_t> kEight{700, 810, 920, 1030, 1140, 1250, 1360, 1470};

TEST(FrozenDevices, AreThoseWhoseFeaturesAllRepeatThemselvesOnAWay) {
  Ring ring(8);
  for (const double x : {0.0, 0.05, 0.1, 0.19}) {
    ring.reads(x, kEight);
    EXPECT_FALSE(ring.isFrozen()) << x;
  }
  ring.reads(0.21, kEight);
  EXPECT_TRUE(ring.isFrozen());
  for (const SensorData* feature : ring.features) EXPECT_TRUE(ring.devices.has(*feature));
  ring.reads(0.21, kEight);
  EXPECT_TRUE(ring.isFrozen()) << "standing does not thaw it";
}

TEST(FrozenDevices, OneFeatureThatChangesTellsThatTheDeviceLives) {
  Ring ring(8);
  std::vector<std::uint32_t> words = kEight;
  for (int i = 0; i < 20; ++i) {
    words[static_cast<std::size_t>(i) % 8] += 1;
    ring.reads(0.1 * i, words);
    EXPECT_FALSE(ring.isFrozen()) << i;
  }
  ring.reads(2.2, words);
  ring.reads(2.4, words);
  EXPECT_TRUE(ring.isFrozen());
  words[3] += 1;
  ring.reads(2.5, words);
  EXPECT_FALSE(ring.isFrozen());
}

// Beside a wall, with nothing in sight elsewhere.
TEST(FrozenDevices, FewDifferentWordsMayComeAgainForEver) {
  Ring ring(8);
  for (int i = 0; i < 20; ++i) ring.reads(0.1 * i, {700, 810, 920, 1030, 3000, 3000, 3000, 3000});
  EXPECT_FALSE(ring.isFrozen());
  for (int i = 20; i < 24; ++i) ring.reads(0.1 * i, {700, 810, 920, 1030, 1140, 3000, 3000, 3000});
  EXPECT_TRUE(ring.isFrozen()) << "six of them";
}

TEST(FrozenDevices, ATurnOnTheSpotKeepsDistancesAsTheyAre) {
  Ring ring(8);
  for (int i = 0; i < 30; ++i) ring.reads(0.0, kEight, 0.1 * i);
  EXPECT_FALSE(ring.isFrozen());
}

// A feature that has nothing new to say is no witness: its device may see other things.
TEST(FrozenDevices, FeaturesThatDoNotComeDoNotCount) {
  Ring ring(8);
  ring.reads(0.0, kEight);
  for (int i = 1; i < 20; ++i) ring.reads(0.1 * i, {700, 810, 920, 1030, 1140});
  EXPECT_FALSE(ring.isFrozen());
  ring.reads(2.0, kEight);
  EXPECT_TRUE(ring.isFrozen());
}

TEST(FrozenDevices, AreForgottenWithTheirTime) {
  Ring ring(8);
  for (int i = 0; i < 5; ++i) ring.reads(0.1 * i, kEight);
  EXPECT_TRUE(ring.isFrozen());
  ring.devices.forget();
  EXPECT_EQ(ring.devices.first(), nullptr);
  ring.reads(0.5, kEight);
  EXPECT_FALSE(ring.isFrozen());
}

}  // namespace
}  // namespace ortung
