/// Where points are in the bytes of a cloud: any layout gives the same points, and nothing that a
/// cloud says of itself is believed.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "CloudLayout.hpp"
#include "CloudMaker.hpp"
#include "Seeded.hpp"

namespace ortung::ros2 {
namespace {

using testing::CloudForm;
using testing::cloudOf;
using testing::CloudPoint;
using Field = PointCloud::Field;

/// All points of a cloud as they come out, in their order.
std::vector<std::array<float, 4>> pointsOf(const PointCloud& cloud, std::size_t piece = 7) {
  std::string why;
  const auto layout = CloudLayout::of(cloud, why);
  EXPECT_TRUE(layout) << why;
  std::vector<std::array<float, 4>> points;
  if (!layout) return points;
  for (std::size_t row = 0; row < layout->rows(); ++row) {
    for (std::size_t first = 0; first < layout->columns(); first += piece) {
      const std::size_t count = std::min(piece, layout->columns() - first);
      std::vector<float> x(count), y(count), z(count), late(count);
      layout->readPlaces(row, first, x, y, z);
      if (layout->hasTimes()) layout->readTimes(row, first, late);
      for (std::size_t i = 0; i < count; ++i) points.push_back({x[i], y[i], z[i], late[i]});
    }
  }
  return points;
}

std::string whyNot(const PointCloud& cloud) {
  std::string why;
  EXPECT_FALSE(CloudLayout::of(cloud, why));
  return why;
}

CloudForm formWithTime(const std::string& name, std::uint8_t type) {
  CloudForm form;
  form.fields.push_back({name, 16, type, 1});
  form.pointStep = 24;
  return form;
}

TEST(CloudLayout, RowsMayHaveGapsBetweenThem) {
  CloudForm form;
  form.rows = 2;
  form.rowPadding = 5;
  const PointCloud cloud = cloudOf({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}, form);
  const auto points = pointsOf(cloud, 1);
  ASSERT_EQ(points.size(), 4u);
  EXPECT_EQ(points[2], (std::array<float, 4>{7, 8, 9, 0}));
  EXPECT_EQ(points[3], (std::array<float, 4>{10, 11, 12, 0}));
}

TEST(CloudLayout, ASingleRowMayNotTellItsLengthAndTheLastOneMayMissItsGap) {
  PointCloud row = cloudOf({{1, 2, 3}, {4, 5, 6}});
  row.rowStep = 0;
  EXPECT_EQ(pointsOf(row).size(), 2u);
  CloudForm form;
  form.rows = 2;
  form.rowPadding = 5;
  PointCloud cloud = cloudOf({{1, 2, 3}, {4, 5, 6}}, form);
  cloud.data.resize(cloud.data.size() - 5);
  EXPECT_EQ(pointsOf(cloud).size(), 2u);
  cloud.data.pop_back();
  EXPECT_NE(whyNot(cloud).find("2 rows of 1 points of 16 bytes, 21 bytes apart, in 36 bytes"),
            std::string::npos);
}

TEST(CloudLayout, ACloudMayHaveNoPoints) {
  PointCloud cloud = cloudOf({{1, 2, 3}});
  cloud.width = 0;
  cloud.height = 4'000'000'000U;
  EXPECT_TRUE(pointsOf(cloud).empty());
}

// 2^32 * 2^32 points, or offsets near 2^32, do not come round to a small number.
TEST(CloudLayout, WhatItSaysOfItselfIsNotBelieved) {
  const PointCloud sound = cloudOf({{1, 2, 3}});
  PointCloud cloud = sound;
  cloud.width = cloud.height = 1U << 31;
  EXPECT_NE(whyNot(cloud).find("expected 4194304 at most"), std::string::npos);
  cloud = sound;
  cloud.width = 2;
  EXPECT_NE(whyNot(cloud).find("in 16 bytes of data"), std::string::npos);
  cloud = sound;
  cloud.height = 2;
  cloud.rowStep = 1;
  cloud.data.resize(1000);
  EXPECT_NE(whyNot(cloud).find("1 bytes apart"), std::string::npos) << "rows lie in one another";
  cloud = sound;
  cloud.pointStep = 0;
  EXPECT_NE(whyNot(cloud).find("a field x from byte 0 on in points of 0 bytes"), std::string::npos);
  cloud = sound;
  cloud.fields[2].offset = 0xFFFFFFFEU;
  EXPECT_NE(whyNot(cloud).find("a field z from byte 4294967294 on"), std::string::npos);
  cloud.fields[2].offset = 13;
  EXPECT_NE(whyNot(cloud).find("a field z from byte 13 on"), std::string::npos);
  for (const int type : {0, 9, 255}) {
    cloud.fields[2] = {"z", 8, static_cast<std::uint8_t>(type), 1};
    EXPECT_NE(whyNot(cloud).find("expected 1 to 8"), std::string::npos);
  }
  cloud.fields.pop_back();
  cloud.fields.pop_back();
  EXPECT_EQ(whyNot(cloud), "found points without z, expected fields x, y and z");
}

// As Ouster tells times (nanoseconds since the stamp), Velodyne (seconds, before or after it),
// Hesai and RoboSense (seconds since 1970) and Livox (nanoseconds since 1970).
TEST(CloudLayout, TimesAreTakenAsDriversTellThem) {
  constexpr std::int64_t kStamp = 1'700'000'000'500'000'000;
  const auto late = [&](const std::string& name, std::uint8_t type, double time) {
    const auto points =
        pointsOf(cloudOf({{1, 2, 3, 0.0}, {1, 2, 3, time}}, formWithTime(name, type), kStamp));
    return static_cast<double>(points.at(1)[3]);
  };
  EXPECT_NEAR(late("t", 6, 40e6), 0.04, 1e-9);
  EXPECT_NEAR(late("time", 7, 0.04), 0.04, 1e-8);
  EXPECT_NEAR(late("time", 7, -0.04), -0.04, 1e-8);
  EXPECT_NEAR(late("timestamp", 8, 1'700'000'000.54), 0.04, 1e-6);  // 2e-7 s is a double's step
  EXPECT_NEAR(late("timestamp", 8, 1'700'000'000'540'000e0), 0.04, 1e-6);
  EXPECT_NEAR(late("timestamp", 8, 1'700'000'000'540'000'000e0), 0.04, 1e-6);
}

TEST(CloudLayout, TimesThatCanBeNoneAreNotUsed) {
  constexpr std::int64_t kStamp = 1'700'000'000'500'000'000;
  const auto times = [&](const CloudForm& form, double time) {
    std::string why;
    const PointCloud cloud = cloudOf({{1, 2, 3, time}}, form, kStamp);
    const auto layout = CloudLayout::of(cloud, why);
    return layout && layout->hasTimes();
  };
  EXPECT_FALSE(times(CloudForm(), 0.0));
  EXPECT_FALSE(times(formWithTime("t", 4), 100.0)) << "16 bits";
  EXPECT_FALSE(times(formWithTime("time", 8), 5000.0)) << "of no known unit";
  EXPECT_FALSE(times(formWithTime("time", 8), std::numeric_limits<double>::infinity()) &&
               pointsOf(cloudOf({{1, 2, 3, std::nan("")}}, formWithTime("time", 8)))[0][3] != 0.0F);
  CloudForm outside = formWithTime("t", 6);
  outside.fields.back().offset = 20;
  EXPECT_TRUE(times(outside, 100.0));
  outside.pointStep = 23;
  EXPECT_FALSE(times(outside, 100.0)) << "the cloud has its points nevertheless";
  // A point of another second keeps its place.
  const auto points =
      pointsOf(cloudOf({{1, 2, 3, 10e6}, {1, 2, 3, 4e9}}, formWithTime("t", 6), kStamp));
  EXPECT_NEAR(static_cast<double>(points[0][3]), 0.01, 1e-9);
  EXPECT_EQ(points[1][3], 0.0F);
}

/// A layout of any order, types, gaps and byte order, whose fields do not overlap.
CloudForm anyForm() {
  CloudForm form;
  std::vector<std::string> names{"x", "y", "z", "ring", "intensity", "t"};
  for (std::size_t i = names.size() - 1; i > 0; --i)
    std::swap(names[i], names[*rc::gen::inRange<std::size_t>(0, i + 1)]);
  form.fields.clear();
  constexpr std::array<std::uint32_t, 9> kSizes{0, 1, 1, 2, 2, 4, 4, 4, 8};
  std::uint32_t offset = 0;
  for (const std::string& name : names) {
    offset += *rc::gen::inRange(0U, 4U);
    const auto type = name == "t" ? std::uint8_t{6} : *rc::gen::inRange<std::uint8_t>(1, 9);
    form.fields.push_back({name, offset, type, *rc::gen::inRange(0U, 2U)});
    offset += kSizes[type];
  }
  form.pointStep = offset + *rc::gen::inRange(0U, 9U);
  form.rows = *rc::gen::inRange(1U, 5U);
  form.rowPadding = *rc::gen::inRange(0U, 20U);
  form.isBigEndian = *rc::gen::arbitrary<bool>();
  return form;
}

// Whole numbers of 7 bits without a sign are the same in all types.
RC_GTEST_PROP(CloudLayoutProperty, AnyLayoutGivesTheSamePoints, ()) {
  const CloudForm form = anyForm();
  std::vector<CloudPoint> points;
  const std::size_t columns = *rc::gen::inRange<std::size_t>(1, 20);
  for (std::size_t i = 0; i < columns * form.rows; ++i) {
    const auto any = [] { return static_cast<double>(*rc::gen::inRange(0, 128)); };
    points.push_back({any(), any(), any(), 1e6 * any()});
  }
  const auto found = pointsOf(cloudOf(points, form), *rc::gen::inRange<std::size_t>(1, 30));
  RC_ASSERT(found.size() == points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    RC_ASSERT(found[i][0] == static_cast<float>(points[i].x));
    RC_ASSERT(found[i][1] == static_cast<float>(points[i].y));
    RC_ASSERT(found[i][2] == static_cast<float>(points[i].z));
    RC_ASSERT(std::abs(static_cast<double>(found[i][3]) - 1e-9 * points[i].time) < 1e-8);
  }
}

// Sizes and offsets of any kind beside any number of bytes: what is taken lies within them, which
// sanitizers see.
RC_GTEST_PROP(CloudLayoutProperty, AnyNumbersAreALayoutOrRefused, ()) {
  PointCloud cloud = cloudOf({{1, 2, 3}});
  const auto any = [] {
    return *rc::gen::weightedOneOf<std::uint32_t>(
        {{3, rc::gen::inRange(0U, 40U)}, {1, rc::gen::arbitrary<std::uint32_t>()}});
  };
  cloud.width = any();
  cloud.height = any();
  cloud.pointStep = any();
  cloud.rowStep = any();
  cloud.isBigEndian = *rc::gen::arbitrary<bool>();
  for (Field& field : cloud.fields)
    field = {field.name, any(), *rc::gen::inRange<std::uint8_t>(0, 10), any()};
  cloud.data.resize(*rc::gen::inRange<std::size_t>(0, 2000));
  std::string why;
  const auto layout = CloudLayout::of(cloud, why);
  RC_ASSERT(layout.has_value() == why.empty());
  if (layout) RC_ASSERT(pointsOf(cloud).size() == std::size_t{cloud.width} * cloud.height);
}

}  // namespace
}  // namespace ortung::ros2
