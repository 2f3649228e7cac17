#include "ortung/core/Plugin.hpp"
#include "ortung/robot/RobotFile.hpp"

using namespace ortung;
namespace {
DeviceData makeName(const Parameters& /*settings*/) { return {}; }

class NameExtractor : public Extractor {
 public:
  explicit NameExtractor(const Parameters& /*settings*/) {}
  std::vector<std::string> inputs() const override { return {}; }
  void take(std::span<const SensorData* const> /*inputs*/) override {}
  void extract(const FieldModel& /*field*/, std::span<std::optional<Words>> /*words*/) override {}
};
}  // namespace

// the block
