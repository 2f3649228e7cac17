#pragma once

#include "ortung/core/Message.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// What a localization found out, as a feature for others to read. It says nothing about the pose
/// that its readings have not said already, so it weighs no samples.
class EstimateData final : public PoseFixData {
 public:
  EstimateData();
  ~EstimateData() override;
  bool localizes() const override { return false; }

  static Message message(const PoseEstimate& estimate);

 private:
  std::shared_ptr<const Weigher> makeWeigher() const override { return nullptr; }
};

}  // namespace ortung
