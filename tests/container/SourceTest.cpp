#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/core/Source.hpp"

namespace ortung {
namespace {

using test::messageOf;

TEST(SourceText, HasKindPathAndOptions) {
  const SourceText plain = parseSourceText("record:logs/a run.rec");
  EXPECT_EQ(plain.kind, "record");
  EXPECT_EQ(plain.path, "logs/a run.rec");
  EXPECT_TRUE(plain.options.empty());
  const SourceText full = parseSourceText("mrclam:data/ds6?robot=3&x=a=b&empty=");
  EXPECT_EQ(full.kind, "mrclam");
  EXPECT_EQ(full.path, "data/ds6");
  EXPECT_EQ(full.options,
            (std::map<std::string, std::string>{{"robot", "3"}, {"x", "a=b"}, {"empty", ""}}));
  EXPECT_EQ(parseSourceText("sim:").path, "");
  EXPECT_TRUE(parseSourceText("sim:a?").options.empty());
}

TEST(SourceText, RefusesWhatIsNone) {
  for (const char* text : {"", "record", ":path", "Re:x", "a b:x", "../x:y"}) {
    EXPECT_EQ(messageOf<std::invalid_argument>([&] { parseSourceText(text); }),
              std::string("source '") + text +
                  "': expected KIND:PATH[?key=value&...], e.g. record:run.rec, or a record, bag or "
                  "log that says what it is");
  }
  EXPECT_EQ(messageOf<std::invalid_argument>([] { parseSourceText("a:b?c"); }),
            "source 'a:b?c': option 'c' is not key=value");
  EXPECT_EQ(messageOf<std::invalid_argument>([] { parseSourceText("a:b?=1"); }),
            "source 'a:b?=1': option '=1' is not key=value");
  EXPECT_EQ(messageOf<std::invalid_argument>([] { parseSourceText("a:b?c=1&c=2"); }),
            "source 'a:b?c=1&c=2': option 'c' is given twice");
}

struct Listed : Source {
  explicit Listed(std::vector<Message> all) : messages(std::move(all)) {}
  bool next(Message& message) override {
    if (at == messages.size()) return false;
    message = messages[at++];
    return true;
  }
  std::vector<Message> messages;
  std::size_t at = 0;
};

Message at(Timestamp stamp, const std::string& feature) { return {stamp, {"M", "T", feature}, {}}; }

TEST(FrameReader, GroupsByTimeAndKeepsTheOrder) {
  Listed source({at(-5, "a"), at(1, "b"), at(1, "c"), at(1, "b"), at(2, "a")});
  FrameReader reader(source);
  std::vector<Message> frame;
  ASSERT_TRUE(reader.next(frame));
  EXPECT_EQ(frame, std::vector{at(-5, "a")});
  ASSERT_TRUE(reader.next(frame));
  EXPECT_EQ(frame, (std::vector{at(1, "b"), at(1, "c"), at(1, "b")}));
  ASSERT_TRUE(reader.next(frame));
  EXPECT_EQ(frame, std::vector{at(2, "a")});
  EXPECT_FALSE(reader.next(frame));
  EXPECT_FALSE(reader.next(frame));
  EXPECT_TRUE(frame.empty());
}

TEST(FrameReader, RefusesTimeThatRunsBackwards) {
  Listed source({at(5, "a"), at(4, "b")});
  FrameReader reader(source);
  std::vector<Message> frame;
  EXPECT_EQ(messageOf<std::runtime_error>([&] { reader.next(frame); }),
            "time runs backwards: M/T/b at 4 us after 5 us");
}

// Records may hold any stamp; players calculate with differences of them.
TEST(FrameReader, RefusesTimesWhoseDifferencesOverflow) {
  constexpr Timestamp kFarthest = Timestamp{1} << 60;
  Listed fine({at(-kFarthest, "a"), at(kFarthest, "a")});
  FrameReader reader(fine);
  std::vector<Message> frame;
  EXPECT_TRUE(reader.next(frame));
  EXPECT_TRUE(reader.next(frame));
  for (const Timestamp far : {-kFarthest - 1, kFarthest + 1}) {
    Listed source({at(far, "a")});
    FrameReader other(source);
    EXPECT_EQ(messageOf<std::runtime_error>([&] { other.next(frame); }),
              "M/T/a is of " + std::to_string(far) + " us, expected a time within 2^60 us of 0");
  }
}

TEST(Source, WithoutAMapSaysSo) {
  Listed source({});
  EXPECT_EQ(source.progress(), -1.0);
  EXPECT_EQ(source.worldFingerprint(), "");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { source.writeWorld("x"); }),
            "these readings come without a map, so no world can be written");
}

}  // namespace
}  // namespace ortung
