// A plugin without a simulation half: its distance is twice that of post 1.
#include "ortung/core/Extractor.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace ortung {
namespace {

DeviceData makeTwice(const Parameters&) {
  DeviceData data;
  data.push_back(std::make_unique<ScalarData>(SensorId{"made", "test", "twice"}, Pose2{},
                                              ScalarData::Config{}));
  return data;
}

class Twice : public Extractor {
 public:
  explicit Twice(const Parameters&) {}
  std::vector<std::string> inputs() const override { return {"*/*/post1Distance"}; }
  void take(std::span<const SensorData* const> inputs) override {
    seen_.clear();
    if (inputs[0] == nullptr) return;
    for (const std::uint32_t word : inputs[0]->getData()) seen_.push_back(2 * word);
  }
  void extract(const FieldModel&, std::span<std::optional<Words>> words) override {
    words[0] = seen_;
  }

 private:
  Words seen_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("twice_data", ortung::provideData<ortung::makeTwice>("twice"),
               ortung::provide<ortung::Extractor, ortung::Twice>("twice"));
