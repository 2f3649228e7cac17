#include "ortung/run/Localization.hpp"

namespace {
void use(const ortung::Pose2& /*pose*/) {}
}  // namespace

int main() {
  // the block
}
