#pragma once

#include <algorithm>

namespace ortung::refbox {

/// How often something may still happen: it grows back with time, up to what may happen at once.
class Budget {
 public:
  Budget(double most, double perSecond) : most_(most), perSecond_(perSecond), left_(most) {}

  /// Takes one, if there is one. @param now [s]
  bool take(double now) {
    left_ = std::min(most_, left_ + perSecond_ * std::max(0.0, now - now_));
    now_ = now;
    if (left_ < 1.0) return false;
    left_ -= 1.0;
    return true;
  }

 private:
  double most_;
  double perSecond_;
  double left_;
  double now_ = 0.0;
};

}  // namespace ortung::refbox
