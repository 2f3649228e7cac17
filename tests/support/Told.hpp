#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "FakeRoom.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung::test {

/// A feature whose answer, and how finely its tables know poses, the test gives.
struct Told : SensorData {
  using Answer = std::function<float(const SampleView&, std::size_t)>;
  Told(const char* name, Answer a, PoseResolution r = {})
      : SensorData({"told", "test", name}), answer(std::move(a)), resolution(r) {
    beginLearning(Room{}.region(0.5, 0.2), 0.1);
    endLearning();
  }
  Format format() const override { return Format("told"); }
  std::string wordsHelp() const override { return ""; }
  bool localizes() const override { return true; }
  void check(std::span<const std::uint32_t>) const override {}
  void decode(std::span<const std::uint32_t>) override {}
  std::shared_ptr<const Weigher> makeWeigher() const override {
    struct Telling : Weigher {
      Telling(Answer a, PoseResolution r) : answer(std::move(a)), its(r) {}
      void weigh(const SampleView& poses, std::span<float> logProbability) const override {
        for (std::size_t i = 0; i < poses.size(); ++i) logProbability[i] += answer(poses, i);
      }
      PoseResolution resolution() const override { return its; }
      Answer answer;
      PoseResolution its;
    };
    return std::make_shared<Telling>(answer, resolution);
  }
  Answer answer;
  PoseResolution resolution;
};

}  // namespace ortung::test
