// A robot that is localized by clouds errs about as one does that has a planar scanner in the
// lidar's place. tests/bench/CloudAccuracy.cpp is the same at length.
#include <gtest/gtest.h>

#include "CloudDrive.hpp"
#include "Files.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::testing {
namespace {

TEST(CloudDrive, CloudsLocalizeAboutAsAPlanarScannerDoes) {
  const test::TemporaryFolder folder;
  CloudDrive drive(folder.path(), 18.0, 1);
  const Lidar lidar{.rings = 16, .columns = 360};
  const DriveErrors scanner = drive.byScanner();
  EXPECT_GT(scanner.count, 100u);
  EXPECT_LT(scanner.median, 0.03);
  const DriveErrors level = drive.byClouds(lidar, {});
  EXPECT_LE(level.median, 1.2 * scanner.median);
  const CloudUse leaning{.tilt = radians(3.0)};
  const DriveErrors levelled = drive.byClouds(lidar, leaning);
  EXPECT_LE(levelled.median, 1.5 * scanner.median);
  CloudUse raw = leaning;
  raw.isLevelled = false;
  const DriveErrors unlevelled = drive.byClouds(lidar, raw);
  EXPECT_GT(unlevelled.median, levelled.median);
  RecordProperty("scanner_mm", std::to_string(1000 * scanner.median));
  RecordProperty("clouds_mm", std::to_string(1000 * level.median));
  RecordProperty("levelled_mm", std::to_string(1000 * levelled.median));
  RecordProperty("not_levelled_mm", std::to_string(1000 * unlevelled.median));
}

}  // namespace
}  // namespace ortung::testing
