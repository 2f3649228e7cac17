// MCL's samples beside the belief by quadrature.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "VagueRoom.hpp"

namespace ortung {
namespace {

using test::McLocalizer;
using test::Quadrature;
using test::Reading;
using test::VagueDrive;

// What sampling may be off: 60000 samples drawn from a pool of tempered candidates are worth some
// thousands, so the mean is known to 2 % of a sigma and the covariance to a few per cent; the
// grid's own cells add (0.05 m)^2 / 12 and (5 degrees)^2 / 12 to the variances.
TEST(Quadrature, AndMclAgreeOnMeanAndCovariance) {
  Quadrature grid;
  McLocalizer particles;
  VagueDrive drive;
  for (const double way : {0.0, 0.5, 0.4, 0.3}) {
    const Reading reading = drive.after(way);
    if (way > 0.0) grid.predict(way);
    grid.correct(reading);
    particles.step(way, reading);
    const PoseEstimate expected = grid.moments();
    const PoseEstimate found = particles.mcl->places().front();  // of the samples alone
    EXPECT_GT(found.share, 0.99);
    const double sigma[3] = {std::sqrt(expected.covariance[0]), std::sqrt(expected.covariance[4]),
                             std::sqrt(expected.covariance[8])};
    EXPECT_NEAR(found.pose.x, expected.pose.x, 0.1 * sigma[0]) << "way " << way;
    EXPECT_NEAR(found.pose.y, expected.pose.y, 0.1 * sigma[1]) << "way " << way;
    EXPECT_NEAR(wrapAngle(found.pose.theta - expected.pose.theta), 0.0, 0.1 * sigma[2])
        << "way " << way;
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_NEAR(found.covariance[i], expected.covariance[i], 0.12 * sigma[i / 3] * sigma[i % 3])
          << "way " << way << ", entry " << i;
    }
    EXPECT_LT(sigma[0], 0.4) << "the case is small, but the belief is no point";
    EXPECT_GT(sigma[0], 0.05);
  }
}

// Of n independent samples the divergence is about (bins - 1) / 2n; what is left of it with many
// is that of cells and quadrature.
TEST(Quadrature, IsComeNearerByMclWithMoreSamples) {
  constexpr std::size_t kSamples[] = {500, 2000, 10000};
  constexpr int kSeeds = 4;
  std::array<double, 3> divergence{};
  Quadrature grid;
  std::vector<std::unique_ptr<McLocalizer>> all;
  for (const std::size_t samples : kSamples)
    for (int seed = 1; seed <= kSeeds; ++seed)
      all.push_back(std::make_unique<McLocalizer>(samples, static_cast<std::uint64_t>(seed)));
  VagueDrive drive;
  for (const double way : {0.0, 0.5, 0.4}) {
    const Reading reading = drive.after(way);
    if (way > 0.0) grid.predict(way);
    grid.correct(reading);
    divergence = {};
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i]->step(way, reading);
      divergence[i / kSeeds] += grid.divergenceOf(all[i]->mcl->samples()) / kSeeds;
    }
    RecordProperty("way " + std::to_string(way), std::to_string(divergence[0]) + " " +
                                                     std::to_string(divergence[1]) + " " +
                                                     std::to_string(divergence[2]));
    EXPECT_LT(divergence[1], 0.7 * divergence[0]) << way;
    EXPECT_LT(divergence[2], 0.7 * divergence[1]) << way;
    EXPECT_LT(divergence[2], 0.05) << way;
  }
}

}  // namespace
}  // namespace ortung
