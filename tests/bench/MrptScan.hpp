#pragma once

#include <memory>
#include <span>

#include "ortung/base/SampleView.hpp"

namespace ortung::bench {

/// MRPT's likelihood field (Thrun) over the same field and reading.
class MrptScan {
 public:
  MrptScan();
  ~MrptScan();
  /// Adds the log likelihood of the reading, as MRPT's particle filter asks for it.
  void getProbability(const SampleView& samples, std::span<float> logProbability) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung::bench
