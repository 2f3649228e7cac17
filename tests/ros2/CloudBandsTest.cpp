/// Heights of lidars as options tell them.
#include <gtest/gtest.h>

#include <stdexcept>

#include "CloudBands.hpp"

namespace ortung::ros2 {
namespace {

std::string complaint(const std::string& text) {
  try {
    CloudBands bands;
    bands.takeHeights(text);
    bands.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(CloudBands, EachLidarMayHaveItsOwn) {
  CloudBands bands;
  bands.takeHeights("0.3,1.5;/top/points:0.5,2.5;/low:-0.2,0.1");
  EXPECT_EQ(bands.of("/front").minHeight, 0.3);
  EXPECT_EQ(bands.of("/front").maxHeight, 1.5);
  EXPECT_EQ(bands.of("/top/points").minHeight, 0.5);
  EXPECT_EQ(bands.of("/top/points").maxHeight, 2.5);
  EXPECT_EQ(bands.of("/low").minHeight, -0.2);
  EXPECT_EQ(bands.of("/low").beams, 360) << "all else is that of each";
}

TEST(CloudBands, WhatIsNoBandIsRefused) {
  EXPECT_EQ(complaint(""), "");
  EXPECT_EQ(complaint("0,1;/a:1,2"), "");
  for (const char* text : {"1", "1,2,3", "a,b", "/a:1", ":1,2", "/a:1,2;;", "1;2", "nan,1"})
    EXPECT_NE(complaint(text), "") << text;
  EXPECT_EQ(complaint("/a:x"),
            "has '/a:x', must be LOW,HIGH or TOPIC:LOW,HIGH in m, and ';' between two");
  EXPECT_NE(complaint("/a:2,1").find("must be below the greatest"), std::string::npos);
}

}  // namespace
}  // namespace ortung::ros2
