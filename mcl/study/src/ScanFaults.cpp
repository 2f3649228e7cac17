#include <algorithm>

#include "Disturbance.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

/// A share of the beams, drawn anew in each scan, reads something else.
class BadBeams : public Disturbance {
 public:
  BadBeams(const Fault& fault, const ScanData::Config& scan, const Random& random)
      : share_(fault.values.at(0)),
        isShort_(fault.kind == Fault::Kind::kShort),
        scan_(scan),
        random_(random) {}

  bool alter(Message& message, double, bool isNow) override {
    if (!isNow || message.words.size() != static_cast<std::size_t>(scan_.beams)) return true;
    for (std::uint32_t& word : message.words) {
      const bool isHit = random_.uniform() < share_;
      const double place = random_.uniform();  // always drawn: beams do not depend on each other
      if (!isHit || (isShort_ && word == 0)) continue;
      const double farthest =
          isShort_ ? std::min(words::toMetres(word), scan_.maxRange) : scan_.maxRange;
      if (farthest <= scan_.minRange) continue;
      const double range = scan_.minRange + place * (farthest - scan_.minRange);
      word = std::max(words::fromMetres(range), 1U);
    }
    return true;
  }

 private:
  double share_;
  bool isShort_;
  ScanData::Config scan_;
  Random random_;
};

}  // namespace

std::unique_ptr<Disturbance> makeScanFault(const Fault& fault, const ScanData::Config& scan,
                                           const Random& random) {
  if (fault.kind == Fault::Kind::kCrowd) return makeCrowd(scan, random);
  return std::make_unique<BadBeams>(fault, scan, random);
}

}  // namespace ortung
