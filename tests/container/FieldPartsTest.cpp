#include <gtest/gtest.h>

#include <algorithm>

#include "ortung/tables/FieldParts.hpp"

namespace ortung {
namespace {

/// A region drawn with one letter a cell of 1 m, the first line on top: '#' solid, '-' open but too
/// tight for the robot, ' ' standable.
FieldRegion drawn(const std::vector<std::string>& rows) {
  FieldRegion region;
  region.grid = {0.0, 0.0, 1.0, static_cast<int>(rows.front().size()),
                 static_cast<int>(rows.size())};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char c : *row) {
      region.open.push_back(c != '#');
      region.standable.push_back(c == ' ');
    }
  }
  return region;
}

std::size_t standable(const FieldRegion& region) {
  return static_cast<std::size_t>(
      std::count(region.standable.begin(), region.standable.end(), std::uint8_t{1}));
}

/// Something small gets wherever there is floor.
FieldParts partsOf(const std::vector<std::string>& rows) {
  const FieldRegion region = drawn(rows);
  return {region, region.open};
}

TEST(FieldParts, AreWhatWallsKeepApart) {
  const FieldRegion region = drawn({"##########", "#  #  #  #",
                                    "#  -  #  #",  // a door that is too narrow, and none
                                    "#  #  # ##", "##########"});
  const FieldParts parts(region, region.open);
  ASSERT_EQ(parts.parts().size(), 2u);
  const std::size_t rooms = *parts.partAt(1.5, 1.5);
  const std::size_t closed = *parts.partAt(7.5, 3.5);
  EXPECT_EQ(parts.partAt(5.5, 3.5), rooms) << "maps make doors too narrow";
  EXPECT_EQ(parts.partAt(3.5, 2.5), rooms);
  EXPECT_NE(closed, rooms);
  EXPECT_EQ(parts.partAt(6.5, 2.5), std::nullopt) << "a wall";
  EXPECT_EQ(parts.partAt(-1, 2), std::nullopt);
  EXPECT_EQ(parts.parts()[rooms].cells, 12u) << "nobody can stand in the door";
  EXPECT_EQ(parts.parts()[closed].cells, 5u);
  EXPECT_EQ(parts.main(true), rooms) << "the larger one";
  const FieldRegion left = parts.only(rooms);
  EXPECT_EQ(standable(left), 12u);
  EXPECT_EQ(left.standable[3 * 10 + 7], 0);
  EXPECT_EQ(left.open, region.open) << "sensors may be anywhere";
  EXPECT_THROW(FieldParts(region, {1, 0, 1}), std::invalid_argument);
}

TEST(FieldParts, CornersDoNotConnect) {
  const FieldParts parts(partsOf({" #",  //
                                  "# "}));
  EXPECT_EQ(parts.parts().size(), 2u);
}

TEST(FieldParts, TheOutsideOfAnLIsNotWhereTheRobotIs) {
  const std::vector<std::string> thin = {"####     ",  //
                                         "#  #     ",  //
                                         "#  #     ",  //
                                         "#  ######",  //
                                         "#       #",  //
                                         "#########"};
  const FieldParts parts(partsOf(thin));
  const std::size_t inside = *parts.partAt(1.5, 1.5);
  const std::size_t outside = *parts.partAt(6.5, 4.5);
  EXPECT_LT(parts.parts()[inside].cells, parts.parts()[outside].cells);
  EXPECT_FALSE(parts.parts()[inside].reachesEdge);
  EXPECT_TRUE(parts.parts()[outside].reachesEdge);
  EXPECT_EQ(parts.main(true), inside);
  EXPECT_EQ(parts.main(false), outside) << "of a map the outside is not known, so not standable";
}

TEST(FieldParts, AFieldWithoutWallsIsNoOutside) {
  const FieldParts meadow(partsOf({"          ",  //
                                   "   ####   ",  //
                                   "   #  #   ",  //
                                   "   ####   ",  //
                                   "          "}));
  EXPECT_EQ(meadow.main(true), *meadow.partAt(0.5, 0.5)) << "around the hut";
  EXPECT_EQ(partsOf({"   "}).main(true), 0u);
}

TEST(FieldParts, ReachesTheEdgeOverFloorThatIsTooTightToo) {
  // The robot can't stand next to the border of the field; there is no wall all the same.
  const FieldParts parts(partsOf({"-----",  //
                                  "-   -",  //
                                  "-----"}));
  EXPECT_TRUE(parts.parts()[0].reachesEdge);
}

TEST(FieldParts, ReachesAcrossRowsOnlyWhereTheyTouch) {
  // The last cell of a row and the first of the next are neighbours in memory alone.
  const FieldParts parts(partsOf({" ## ", "####", " ## "}));
  EXPECT_EQ(parts.parts().size(), 4u);
}

TEST(CanStandNear, LooksAsFarAsItIsTold) {
  const FieldRegion region = drawn({"#####",  //
                                    "# ###",  //
                                    "#####"});
  EXPECT_TRUE(canStandNear(region, 1.5, 1.5, 0.0));
  EXPECT_FALSE(canStandNear(region, 3.5, 1.5, 1.9));
  EXPECT_TRUE(canStandNear(region, 3.5, 1.5, 2.0));
  EXPECT_TRUE(canStandNear(region, -1.5, 1.5, 3.0)) << "from beside the map";
  EXPECT_FALSE(canStandNear(region, -1.5, 1.5, 2.9));
  EXPECT_TRUE(canStandNear(region, 1e9, -1e9, 1e10));
  EXPECT_FALSE(canStandNear(region, 1e300, 0, 1.0));
  EXPECT_FALSE(canStandNear(region, std::nan(""), 0, 1.0));
}

}  // namespace
}  // namespace ortung
