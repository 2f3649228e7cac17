// Features made of features: order, circles, what is taken when, threads.
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "Files.hpp"
#include "ortung/core/Extractor.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace ortung {
namespace {

using Words = Extractor::Words;
using test::messageOf;

SensorData& addScalar(SensorContainer& container, const std::string& feature) {
  return container.add(
      std::make_unique<ScalarData>(SensorId{"m", "t", feature}, Pose2{}, ScalarData::Config{}));
}

std::uint32_t wordOf(const SensorData& data) {
  return data.getData().empty() ? 0 : data.getData()[0];
}

/// Adds its inputs up, and one. Gives nothing while one of them has no reading.
struct Sum : Extractor {
  explicit Sum(std::vector<std::string> from) : names(std::move(from)) {}
  std::vector<std::string> inputs() const override { return names; }
  void take(std::span<const SensorData* const> readings) override {
    sum.reset();
    std::uint32_t total = 1;
    for (const SensorData* one : readings) {
      if (one == nullptr) return;
      total += wordOf(*one);
    }
    sum = total;
  }
  void extract(const FieldModel& field, std::span<std::optional<Words>> words) override {
    if (sum) words[0] = Words{*sum + static_cast<std::uint32_t>(field.walls.size())};
    ++runs;
  }
  std::vector<std::string> names;
  std::optional<std::uint32_t> sum;
  int runs = 0;
};

TEST(Extractor, FollowsWhatReadsWhatWhateverTheOrderOfAdding) {
  SensorContainer container;
  SensorData& c = addScalar(container, "c");
  SensorData& b = addScalar(container, "b");
  addScalar(container, "a");
  container.add("c of b", std::make_unique<Sum>(std::vector<std::string>{"m/t/b"}), {&c});
  container.add("b of a", std::make_unique<Sum>(std::vector<std::string>{"*/*/a"}), {&b});
  container.connect();
  container.set({.stamp = 7, .id = {"m", "t", "a"}, .words = {10}});
  EXPECT_EQ(wordOf(b), 11u);
  EXPECT_EQ(wordOf(c), 12u) << "in one go";
  EXPECT_EQ(c.stamp(), 7) << "of what it is made of";
  auto field = std::make_shared<FieldModel>();
  field->walls.resize(100);
  container.setField(field);
  container.set({.stamp = 8, .id = {"m", "t", "a"}, .words = {20}});
  EXPECT_EQ(wordOf(c), 222u);
}

TEST(Extractor, RunsOnlyWhenAnInputIsNew) {
  SensorContainer container;
  addScalar(container, "a");
  addScalar(container, "other");
  SensorData& b = addScalar(container, "b");
  auto owned = std::make_unique<Sum>(std::vector<std::string>{"m/t/a"});
  const Sum& sum = *owned;
  container.add("b", std::move(owned), {&b});
  container.connect();
  container.set({.stamp = 1, .id = {"m", "t", "other"}, .words = {1}});
  container.extract();
  EXPECT_EQ(sum.runs, 0);
  container.set({.stamp = 2, .id = {"m", "t", "a"}, .words = {1}});
  container.extract();
  container.set({.stamp = 3, .id = {"m", "t", "other"}, .words = {1}});
  EXPECT_EQ(sum.runs, 1);
  EXPECT_EQ(b.sequence(), 1u);
}

TEST(Extractor, LeavesWhatCameReadyMade) {
  SensorContainer container;
  addScalar(container, "a1");
  addScalar(container, "a2");
  SensorData& b = addScalar(container, "b");
  container.add("b", std::make_unique<Sum>(std::vector<std::string>{"m/t/a1", "m/t/a2"}), {&b});
  container.connect();
  container.set({.stamp = 1, .id = b.id(), .words = {500}});
  container.set({.stamp = 2, .id = {"m", "t", "a1"}, .words = {1}});
  EXPECT_EQ(wordOf(b), 500u) << "a2 has no reading yet: nothing is made";
  const std::vector<Message> frame = {{3, {"m", "t", "a2"}, {2}}, {3, b.id(), {600}}};
  container.set(frame);
  EXPECT_EQ(wordOf(b), 600u) << "of the same moment: the sender made it";
  container.set({.stamp = 3, .id = {"m", "t", "a2"}, .words = {2}});
  EXPECT_EQ(wordOf(b), 600u);
  container.set({.stamp = 4, .id = {"m", "t", "a2"}, .words = {2}});
  EXPECT_EQ(wordOf(b), 4u);
  container.set({.stamp = 4, .id = {"m", "t", "a2"}, .words = {5}});
  EXPECT_EQ(wordOf(b), 7u) << "made here before, so made again";
}

TEST(Extractor, RefusesCirclesWithTheNamesInThem) {
  SensorContainer container;
  SensorData& a = addScalar(container, "a");
  SensorData& b = addScalar(container, "b");
  SensorData& c = addScalar(container, "c");
  addScalar(container, "d");
  container.add("first", std::make_unique<Sum>(std::vector<std::string>{"m/t/b"}), {&a});
  container.add("second", std::make_unique<Sum>(std::vector<std::string>{"m/t/a"}), {&b});
  container.add("third", std::make_unique<Sum>(std::vector<std::string>{"m/t/d"}), {&c});
  const auto said = messageOf<std::invalid_argument>([&] { container.connect(); });
  EXPECT_NE(said.find("first"), said.npos) << said;
  EXPECT_NE(said.find("second"), said.npos) << said;
  EXPECT_EQ(said.find("third"), said.npos) << said;
}

TEST(Extractor, AStarDoesNotMeanItsOwnFeatures) {
  SensorContainer container;
  SensorData& b = addScalar(container, "b");
  addScalar(container, "a");
  container.add("b", std::make_unique<Sum>(std::vector<std::string>{"*/*/*"}), {&b});
  container.connect();
  container.set({.stamp = 1, .id = {"m", "t", "a"}, .words = {3}});
  EXPECT_EQ(wordOf(b), 4u);
}

TEST(Extractor, RefusesInputsThatAreNotThere) {
  SensorContainer container;
  SensorData& a = addScalar(container, "a");
  container.add("sum", std::make_unique<Sum>(std::vector<std::string>{"m/t/nobody"}), {&a});
  const auto said = messageOf<std::invalid_argument>([&] { container.connect(); });
  EXPECT_NE(said.find("sum"), said.npos) << said;
  EXPECT_NE(said.find("m/t/nobody"), said.npos) << said;
}

/// Does what it is told to do when it extracts.
struct Told : Extractor {
  explicit Told(std::function<void(std::span<std::optional<Words>>)> f) : action(std::move(f)) {}
  std::vector<std::string> inputs() const override { return {"m/t/a"}; }
  void take(std::span<const SensorData* const>) override {}
  void extract(const FieldModel&, std::span<std::optional<Words>> words) override { action(words); }
  std::function<void(std::span<std::optional<Words>>)> action;
};

TEST(Extractor, ItsTroubleIsToldByNameAndReadingsStay) {
  const std::vector<std::function<void(std::span<std::optional<Words>>)>> troubles = {
      [](auto) { throw std::runtime_error("no idea"); }, [](auto) { throw 42; },
      [](std::span<std::optional<Words>> words) { words[0] = Words{1, 2, 3}; },  // refused words
  };
  for (const auto& trouble : troubles) {
    SensorContainer container;
    SensorData& a = addScalar(container, "a");
    SensorData& b = addScalar(container, "b");
    container.add("broken", std::make_unique<Told>(trouble), {&b});
    container.connect();
    const auto said =
        messageOf<ExtractorError>([&] { container.set({.stamp = 1, .id = a.id(), .words = {5}}); });
    EXPECT_NE(said.find("broken"), said.npos) << said;
    EXPECT_EQ(wordOf(a), 5u);
    EXPECT_EQ(b.sequence(), 0u);
  }
}

TEST(Extractor, IsNamedByWhatItMakes) {
  const auto said = [](int outputs) {
    SensorContainer container;
    const SensorData& a = addScalar(container, "a");
    std::vector<SensorData*> made;
    for (int i = 0; i < outputs; ++i)
      made.push_back(&addScalar(container, "b" + std::to_string(i)));
    container.add("broken", std::make_unique<Told>([](auto) { throw std::runtime_error("oh"); }),
                  made);
    container.connect();
    return messageOf<ExtractorError>(
        [&] { container.set({.stamp = 1, .id = a.id(), .words = {5}}); });
  };
  EXPECT_TRUE(said(1).starts_with("the extractor of 'broken', which makes m/t/b0,")) << said(1);
  EXPECT_TRUE(said(3).starts_with("the extractor of 'broken', which makes m/t/b0 and 2 more,"))
      << said(3);
}

/// While an extractor computes, others read and write; what came meanwhile is made afterwards.
TEST(ExtractorThreads, NobodyWaitsForIt) {
  constexpr auto kForever = std::chrono::seconds(60);
  SensorContainer container;
  SensorData& a = addScalar(container, "a");
  SensorData& b = addScalar(container, "b");
  std::promise<void> isExtracting;
  std::promise<void> mayGoOn;
  int runs = 0;
  container.add("slow", std::make_unique<Told>([&](std::span<std::optional<Words>> words) {
                  words[0] = Words{static_cast<std::uint32_t>(++runs)};
                  if (runs > 1) return;
                  isExtracting.set_value();
                  EXPECT_EQ(mayGoOn.get_future().wait_for(kForever), std::future_status::ready);
                }),
                {&b});
  container.connect();
  std::thread device([&] { container.set({.stamp = 1, .id = a.id(), .words = {1}}); });
  ASSERT_EQ(isExtracting.get_future().wait_for(kForever), std::future_status::ready);
  container.set({.stamp = 2, .id = a.id(), .words = {2}});  // returns, though "slow" is at work
  {
    const SensorContainer::ReadLock lock = container.read();
    EXPECT_EQ(wordOf(a), 2u);
  }
  mayGoOn.set_value();
  device.join();
  EXPECT_EQ(runs, 2) << "the second reading was made use of, too";
  EXPECT_EQ(b.stamp(), 2);
}

}  // namespace
}  // namespace ortung
