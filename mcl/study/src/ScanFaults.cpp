#include <algorithm>
#include <cmath>

#include "Disturbance.hpp"

namespace ortung {
namespace {

/// Replaces a share of the entries, drawn anew for each reading: beams of a scan, landmarks of a
/// list, rows of a plugin's format.
class BadEntries : public Disturbance {
 public:
  BadEntries(const Fault& fault, const SensorData& feature, const Random& random)
      : share_(fault.values.at(0)),
        isShort_(fault.kind == Fault::Kind::kShort),
        feature_(feature),
        random_(random) {}

  bool alter(Message& message, double, bool isNow) override {
    if (!isNow || !fits(message.words)) return true;
    std::size_t entry = 0;
    bool isHit = false;
    for (WordValue& value : feature_.valuesIn(message.words)) {
      if (value.entry != entry || value.word == 0) isHit = random_.uniform() < share_;
      entry = value.entry;
      const double place = random_.uniform();  // always drawn: entries do not depend on each other
      if (isHit && (isShort_ ? makeShort(value, place) : makeRandom(value, place)))
        feature_.store(value, message.words);
    }
    return true;
  }

 private:
  bool fits(std::span<const std::uint32_t> words) const {
    try {
      feature_.checkData(words);
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  }

  static bool makeRandom(WordValue& value, double place) {
    if (value.most <= value.least) return false;
    value.value = isAngle(value.kind) ? 0.5 * (value.least + value.most) +
                                            (2.0 * place - 1.0) * (0.5 * (value.most - value.least))
                                      : value.least + place * (value.most - value.least);
    return true;
  }

  static bool makeShort(WordValue& value, double place) {
    if (value.kind != ValueKind::kRange || std::isnan(value.value)) return false;
    const double farthest = std::min(value.value, value.most);
    if (farthest <= value.least) return false;
    value.value = value.least + place * (farthest - value.least);
    return true;
  }

  double share_;
  bool isShort_;
  const SensorData& feature_;
  Random random_;
};

}  // namespace

std::unique_ptr<Disturbance> makeEntriesFault(const Fault& fault, const SensorData& feature,
                                              const Random& random) {
  return std::make_unique<BadEntries>(fault, feature, random);
}

}  // namespace ortung
