#include <vector>

#include "ortung/run/Localization.hpp"

namespace {
void steer(const ortung::Pose2& /*pose*/) {}
}  // namespace

void drive(ortung::Localization& localization, const std::vector<ortung::Message>& readings,
           ortung::Timestamp now);
void drive(ortung::Localization& localization, const std::vector<ortung::Message>& readings,
           ortung::Timestamp now) {
  // the block
}
