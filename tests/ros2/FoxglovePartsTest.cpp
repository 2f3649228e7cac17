/// Parts of Foxglove's sessions: the board's replies, binary frames, and the map of a field.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "BoardReplies.hpp"
#include "FieldMap.hpp"
#include "FoxgloveFrames.hpp"

namespace ortung::foxglove {
namespace {

using namespace std::string_literals;
using Texts = std::vector<std::string>;

TEST(BoardLine, HasWordsAndKeys) {
  const BoardReply reply = parseBoardLine("OK  LIST lines=3 =odd name=a=b x_m=-1.5 lines=9 ");
  EXPECT_EQ(reply.words, (Texts{"OK", "LIST", "=odd"}));
  EXPECT_EQ(reply.text(), "OK LIST =odd");
  EXPECT_TRUE(reply.isOk());
  EXPECT_EQ(reply.keys.at("name"), "a=b");
  EXPECT_EQ(reply.number("lines", 7), 3) << "the first one counts";
  EXPECT_EQ(reply.number("none", 7), 7);
  EXPECT_EQ(reply.number("x_m", 7), 7) << "it is not whole";
  EXPECT_EQ(reply.real("x_m"), -1.5);
  EXPECT_FALSE(reply.real("name"));
  EXPECT_FALSE(reply.real("none"));
  EXPECT_FALSE(parseBoardLine("x=inf").real("x"));
  EXPECT_FALSE(parseBoardLine("").isOk());
  EXPECT_FALSE(parseBoardLine("ERR role").isOk());
}

/// What handlers get: the reply's words, lines and bytes.
struct Heard {
  Texts replies, events;
  std::string sent;
  BoardReplies board{[this](const BoardReply& event) { events.push_back(whole(event)); }};
  static std::string whole(const BoardReply& reply) {
    std::string text = reply.text();
    for (const std::string& line : reply.lines) text += "|" + line;
    return text + (reply.bytes.empty() ? "" : "#" + reply.bytes);
  }
  void ask(const std::string& request) {
    board.ask(
        request,
        [this, request](const BoardReply& r) { replies.push_back(request + ": " + whole(r)); },
        sent);
  }
};

// Replies come in the order of the requests, events between them, however the bytes are cut.
TEST(BoardReplies, GoToTheirRequestsHoweverTheyAreCut) {
  const std::string bytes =
      "OK A\n* EVENT lines=1\nof it\nOK B lines=2\none\n\n* UPDATE bytes=5\n12\n45OK C bytes=0\n";
  for (std::size_t size = 1; size <= bytes.size(); ++size) {
    Heard heard;
    for (const char* request : {"a", "b", "c"}) heard.ask(request);
    EXPECT_EQ(heard.sent, "a\nb\nc\n");
    for (std::size_t i = 0; i < bytes.size(); i += size)
      ASSERT_TRUE(heard.board.take(bytes.substr(i, size)));
    EXPECT_EQ(heard.replies, (Texts{"a: OK A", "b: OK B|one|", "c: OK C"})) << size;
    EXPECT_EQ(heard.events, (Texts{"* EVENT|of it", "* UPDATE#12\n45"})) << size;
  }
}

TEST(BoardReplies, RepliesThatNobodyAskedForAreDropped) {
  Heard heard;
  EXPECT_TRUE(heard.board.take("OK A\n\nOK B\n"));
  heard.ask("c");
  EXPECT_TRUE(heard.board.take("OK C\n"));
  EXPECT_EQ(heard.replies, Texts{"c: OK C"});
}

TEST(BoardReplies, EndlessOnesViolateTheProtocol) {
  for (const std::string line :
       {"OK lines=-1\n", "OK lines=1048577\n", "OK bytes=-1\n", "OK bytes=268435457\n"})
    EXPECT_FALSE(Heard().board.take(line)) << line;
  EXPECT_TRUE(Heard().board.take("OK lines=1048576 bytes=268435456\n"));
  Heard heard;
  EXPECT_TRUE(heard.board.take(std::string(1U << 20, 'x')));
  EXPECT_FALSE(heard.board.take("x"));
}

TEST(FoxgloveFrames, AreTheProtocolsBytes) {
  EXPECT_EQ(messageFrame(0x01020304, 5, "ab"), "\1\4\3\2\1\5\0\0\0\0\0\0\0ab"s);
  EXPECT_EQ(timeFrame(0x0102), "\2\2\1\0\0\0\0\0\0"s);
  EXPECT_EQ(playbackFrame({PlaybackStatus::kEnded, 7, 0.5F, false, "x"}),
            "\5\3\7\0\0\0\0\0\0\0\0\0\0\x3F\0\1\0\0\0x"s);
}

/// A request to play: its command, speed, whether it seeks, the time, and the rest.
std::string request(char command, float speed, char hasSeek, const std::string& rest) {
  std::string bytes = "\3"s + command;
  bytes.append(reinterpret_cast<const char*>(&speed), sizeof speed);
  return bytes + hasSeek + "\x09\0\0\0\0\0\0\0"s + rest;
}

TEST(PlaybackRequests, AreReadWithAndWithoutAnIdentity) {
  const auto play = parsePlaybackRequest(request('\0', 2.5F, '\1', "\2\0\0\0id"s));
  ASSERT_TRUE(play);
  EXPECT_TRUE(play->isPlay);
  EXPECT_EQ(play->speed, 2.5F);
  EXPECT_EQ(play->seek, 9u);
  EXPECT_EQ(play->id, "id");
  const auto pause = parsePlaybackRequest(request('\1', 1000.0F, '\0', ""));
  ASSERT_TRUE(pause) << "as in the first versions";
  EXPECT_FALSE(pause->isPlay);
  EXPECT_FALSE(pause->seek);
  EXPECT_EQ(pause->id, "");
  const std::string longest = "\0\1\0\0"s + std::string(256, 'i');
  EXPECT_TRUE(parsePlaybackRequest(request('\0', 1.0F, '\0', longest)));
}

TEST(PlaybackRequests, ThatAreNoneAreRefused) {
  const std::string right = request('\0', 1.0F, '\0', "");
  for (std::size_t size = 0; size < right.size(); ++size)
    EXPECT_FALSE(parsePlaybackRequest(right.substr(0, size))) << size;
  EXPECT_FALSE(parsePlaybackRequest("\2" + right.substr(1)));
  EXPECT_FALSE(parsePlaybackRequest(request('\2', 1.0F, '\0', "")));
  EXPECT_FALSE(parsePlaybackRequest(request('\0', 1000.5F, '\0', "")));
  EXPECT_FALSE(parsePlaybackRequest(request('\0', 0.0F, '\0', "")));
  EXPECT_FALSE(parsePlaybackRequest(request('\0', 1.0F, '\0', "\3\0\0\0id"s)));
  EXPECT_FALSE(
      parsePlaybackRequest(request('\0', 1.0F, '\0', "\1\1\0\0"s + std::string(257, 'i'))));
}

constexpr const char* kWorld = "x_min_m=-1 y_min_m=-1 x_max_m=1 y_max_m=1";

// 2 m x 2 m and half a metre around, in cells of 5 cm: 60 x 60; a wall of 1 m covers 20 or 21.
TEST(FieldMap, IsOccupiedWhereWallsAre) {
  const auto map =
      mapOfField(parseBoardLine(kWorld),
                 {"wall x0_m=-0.475 y0_m=0.025 x1_m=0.475 y1_m=0.025",
                  "goal x0_m=0 y0_m=0.5 x1_m=0.5 y1_m=0.5", "", "wall x0_m=0 y0_m=0 x1_m=0"});
  ASSERT_TRUE(map);
  EXPECT_EQ(map->header.frame, "map");
  EXPECT_FLOAT_EQ(map->resolution, 0.05F);
  EXPECT_EQ(map->width, 60u);
  EXPECT_EQ(map->height, 60u);
  EXPECT_EQ(map->origin.position.x, -1.5);
  EXPECT_EQ(map->origin.position.y, -1.5);
  ASSERT_EQ(map->data.size(), 3600u);
  for (std::size_t column = 0; column < 60; ++column)
    EXPECT_EQ(map->data[30 * 60 + column], column >= 20 && column < 40 ? 100 : 0) << column;
  EXPECT_EQ(std::count(map->data.begin(), map->data.end(), 100), 20);
}

TEST(FieldMap, WallsReachBeyondItsEdgesAndMayBePoints) {
  const auto map =
      mapOfField(parseBoardLine(kWorld), {"wall x0_m=0.025 y0_m=-9 x1_m=0.025 y1_m=9",
                                          "wall x0_m=1.025 y0_m=1.025 x1_m=1.025 y1_m=1.025"});
  ASSERT_TRUE(map);
  EXPECT_EQ(std::count(map->data.begin(), map->data.end(), 100), 61);
  EXPECT_EQ(map->data[30], 100);
  EXPECT_EQ(map->data[50 * 60 + 50], 100);
}

// A box of 0.6 m x 0.4 m, whose corners run either way round.
TEST(FieldMap, HasSolidsAtTheHeightOfAScanner) {
  for (const char* corners : {"0.025,0.025 0.625,0.025 0.625,0.425 0.025,0.425",
                              "0.025,0.425 0.625,0.425 0.625,0.025 0.025,0.025"}) {
    const Texts lines{std::string("solid z0_m=0 z1_m=0.5 ") + corners,
                      "solid z0_m=0.8 z1_m=0.9 -0.5,-0.5 -0.5,-0.6 -0.6,-0.6", "solid 0,0 1,x"};
    const auto low = mapOfField(parseBoardLine(kWorld), lines, {.height = 0.3});
    ASSERT_TRUE(low);
    EXPECT_EQ(std::count(low->data.begin(), low->data.end(), 100), 2 * 13 + 2 * 7);
    EXPECT_EQ(low->data[30 * 60 + 30], 100);
    EXPECT_EQ(low->data[38 * 60 + 42], 100);
    const auto all = mapOfField(parseBoardLine(kWorld), lines);
    ASSERT_TRUE(all);
    EXPECT_GT(std::count(all->data.begin(), all->data.end(), 100),
              std::count(low->data.begin(), low->data.end(), 100));
  }
}

// The surfaces of a box from (-0.5, -0.5) to (0.5, 0.5) are edges of cells: those inside are
// occupied, so that the map's surfaces are where a scanner sees them.
TEST(FieldMap, OfAScannerIsOccupiedBehindSurfaces) {
  for (const char* corners :
       {"-0.5,-0.5 0.5,-0.5 0.5,0.5 -0.5,0.5", "-0.5,0.5 0.5,0.5 0.5,-0.5 -0.5,-0.5"}) {
    const auto map =
        mapOfField(parseBoardLine(kWorld), {std::string("solid z0_m=0 z1_m=0.5 ") + corners},
                   {.isBehindSurfaces = true});
    ASSERT_TRUE(map);
    for (const int cell : {20, 39}) {  // from -0.5 to -0.45, and from 0.45 to 0.5
      EXPECT_EQ(map->data[30 * 60 + cell], 100);
      EXPECT_EQ(map->data[cell * 60 + 30], 100);
    }
    for (const int cell : {18, 19, 21, 38, 40, 41}) {
      EXPECT_EQ(map->data[30 * 60 + cell], 0) << cell;
      EXPECT_EQ(map->data[cell * 60 + 30], 0) << cell;
    }
  }
  const auto wall = mapOfField(parseBoardLine(kWorld), {"wall x0_m=0 y0_m=-1 x1_m=0 y1_m=1"},
                               {.isBehindSurfaces = true});
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->data[30 * 60 + 30], 100) << "a solid is on the right of the way";
  EXPECT_EQ(wall->data[30 * 60 + 29], 0);
}

// 900 m x 900 m in cells of 5 cm would be 324 million: there are at most 131072, about 2.5 m wide.
TEST(FieldMap, OfALargeFieldHasLargerCells) {
  const auto map = mapOfField(parseBoardLine("x_min_m=0 y_min_m=0 x_max_m=899 y_max_m=899"),
                              {"wall x0_m=1 y0_m=1 x1_m=9 y1_m=1"});
  ASSERT_TRUE(map);
  EXPECT_NEAR(map->resolution, std::sqrt(900.0 * 900.0 / 131072), 1e-4);
  EXPECT_EQ(map->width, 363u);
}

TEST(FieldMap, NeedsBoundsAndAWall) {
  const Texts wall{"wall x0_m=0 y0_m=0 x1_m=0.5 y1_m=0"};
  EXPECT_TRUE(mapOfField(parseBoardLine(kWorld), wall));
  EXPECT_FALSE(mapOfField(parseBoardLine(kWorld), {}));
  EXPECT_FALSE(mapOfField(parseBoardLine(kWorld), {"wall x0_m=50 y0_m=50 x1_m=60 y1_m=50"}));
  for (const char* world :
       {"", "x_min_m=-1 y_min_m=-1 x_max_m=1", "x_min_m=5 y_min_m=-1 x_max_m=1 y_max_m=1",
        "x_min_m=-1 y_min_m=-1 x_max_m=1e6 y_max_m=1"})
    EXPECT_FALSE(mapOfField(parseBoardLine(world), wall)) << world;
}

}  // namespace
}  // namespace ortung::foxglove
