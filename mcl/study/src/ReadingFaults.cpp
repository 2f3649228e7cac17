#include <optional>
#include <vector>

#include "Disturbance.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {
namespace {

class Missing : public Disturbance {
 public:
  bool alter(Message&, double, bool isNow) override { return !isNow; }
};

class Frozen : public Disturbance {
 public:
  bool alter(Message& message, double, bool isNow) override {
    if (!isNow) return true;
    if (!kept_) kept_ = message.words;
    message.words = *kept_;
    return true;
  }

 private:
  std::optional<std::vector<std::uint32_t>> kept_;
};

class Dropped : public Disturbance {
 public:
  Dropped(double share, const Random& random) : share_(share), random_(random) {}
  bool alter(Message&, double, bool isNow) override {
    return !isNow || random_.uniform() >= share_;
  }

 private:
  double share_;
  Random random_;
};

/// Delays stamps. The caller that passes the readings on keeps stamps in order.
class Late : public Disturbance {
 public:
  explicit Late(double seconds) : delay_(fromSeconds(seconds)) {}
  bool alter(Message& message, double, bool isNow) override {
    if (isNow) message.stamp += delay_;
    return true;
  }

 private:
  Timestamp delay_;
};

}  // namespace

std::unique_ptr<Disturbance> makeReadingFault(const Fault& fault, const Random& random) {
  switch (fault.kind) {
    case Fault::Kind::kFrozen:
      return std::make_unique<Frozen>();
    case Fault::Kind::kDrop:
      return std::make_unique<Dropped>(fault.values.at(0), random);
    case Fault::Kind::kLate:
      return std::make_unique<Late>(fault.values.at(0));
    default:
      return std::make_unique<Missing>();
  }
}

}  // namespace ortung
