// A long update of MCL holds up nobody who fills the container.
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr auto kForever = std::chrono::seconds(60);  // for a test: only a failure waits that long

/// Says that it weighs, and goes on when it may.
struct Rendezvous {
  std::promise<void> isWeighing;
  std::promise<void> mayGoOn;
};

struct SlowWeigher : Weigher {
  explicit SlowWeigher(Rendezvous* r) : rendezvous(r) {}
  void weigh(const SampleView&, std::span<float> logProbability) const override {
    for (float& v : logProbability) v -= 1.0F;
    if (rendezvous == nullptr || hasMet) return;
    hasMet = true;
    rendezvous->isWeighing.set_value();
    EXPECT_EQ(rendezvous->mayGoOn.get_future().wait_for(kForever), std::future_status::ready)
        << "set() was held up by an update";
  }
  Rendezvous* rendezvous;
  mutable bool hasMet = false;
};

/// A feature whose first reading takes as long to weigh as the test wants.
struct SlowData : SensorData {
  explicit SlowData(Rendezvous& r) : SensorData({"slow", "test", "x"}), rendezvous(r) {}
  Format format() const override { return Format("told"); }
  std::string wordsHelp() const override { return ""; }
  bool localizes() const override { return true; }
  void check(std::span<const std::uint32_t>) const override {}
  void decode(std::span<const std::uint32_t>) override {}
  std::shared_ptr<const Weigher> makeWeigher() const override {
    return std::make_shared<SlowWeigher>(sequence() == 1 ? &rendezvous : nullptr);
  }
  Rendezvous& rendezvous;
};

TEST(LockThreads, SetIsNotHeldUpByALongUpdate) {
  const FieldRegion region{{0.0, 0.0, 0.1, 10, 10},
                           std::vector<std::uint8_t>(100, 1),
                           std::vector<std::uint8_t>(100, 1)};
  Rendezvous rendezvous;
  SensorContainer container;
  SensorData& slow = container.add(std::make_unique<SlowData>(rendezvous));
  slow.beginLearning(region, 0.1);
  slow.endLearning();
  container.set({.stamp = 1, .id = slow.id(), .words = {1}});

  MclConfig config;
  config.threads = 1;
  Mcl mcl(config, region, std::make_unique<OdometryMotion>());
  mcl.startAt({0.5, 0.5, 0.0}, 0.1, 0.1);
  std::thread device([&] {
    const bool began =
        rendezvous.isWeighing.get_future().wait_for(kForever) == std::future_status::ready;
    EXPECT_TRUE(began);
    container.set({.stamp = 2, .id = slow.id(), .words = {2}});
    rendezvous.mayGoOn.set_value();
  });
  EXPECT_TRUE(mcl.update(container));
  device.join();
  EXPECT_EQ(mcl.estimate().stamp, 1) << "the reading that it began with";
  EXPECT_EQ(slow.sequence(), 2u);
  config.maxInterval = 0.0;
  EXPECT_EQ(slow.getData()[0], 2u);
}

/// Readers of all kinds while somebody writes: the thread sanitizer looks on.
TEST(LockThreads, WeighersStayAsTheyAreWhileReadingsChange) {
  const FieldRegion region{{0.0, 0.0, 0.1, 10, 10},
                           std::vector<std::uint8_t>(100, 1),
                           std::vector<std::uint8_t>(100, 1)};
  Rendezvous unused;
  SensorContainer container;
  SensorData& slow = container.add(std::make_unique<SlowData>(unused));
  slow.beginLearning(region, 0.1);
  slow.endLearning();
  slow.setData(1, std::vector<std::uint32_t>{0});
  slow.setData(1, std::vector<std::uint32_t>{0});
  std::thread writer([&] {
    for (Timestamp i = 2; i < 500; ++i)
      container.set({.stamp = i, .id = slow.id(), .words = {static_cast<std::uint32_t>(i)}});
  });
  std::vector<std::thread> readers;
  for (int k = 0; k < 2; ++k) {
    readers.emplace_back([&] {
      for (int i = 0; i < 500; ++i) {
        std::shared_ptr<const Weigher> weigher;
        {
          const SensorContainer::ReadLock lock = container.read();
          weigher = slow.weigher();
        }
        EXPECT_NEAR(weigher->getProbability({0.5, 0.5, 0.0}), std::exp(-1.0), 1e-6);
      }
    });
  }
  writer.join();
  for (std::thread& reader : readers) reader.join();
}

}  // namespace
}  // namespace ortung
