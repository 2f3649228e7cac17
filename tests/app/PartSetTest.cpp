// Parts that nobody has made honestly.
#include <gtest/gtest.h>

#include "Console.hpp"
#include "ContentDigest.hpp"
#include "EvalParts.hpp"
#include "Files.hpp"
#include "PartSet.hpp"
#include "PictureParts.hpp"
#include "ProgramFiles.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

class PartSetTest : public testing::Test {
 protected:
  /// Writes a part with one array.
  fs::path part(const std::string& name, PartHead head, const std::string& text = "x") const {
    PartWriter writer(folder_ / name, std::move(head));
    addLongText(writer.content(), "text", text);
    writer.commit();
    return folder_ / name;
  }
  static PartHead head(std::uint64_t number, std::uint64_t count, const std::string& job = "{}") {
    return {"test", job, {number, count}};
  }
  static std::string whyNot(const std::vector<fs::path>& files) {
    try {
      const PartSet set(files);
    } catch (const PartError& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

TEST_F(PartSetTest, OrdersPartsByNumber) {
  const PartSet set({part("b", head(2, 2), "two"), part("a", head(1, 2), "one")});
  ASSERT_EQ(set.size(), 2u);
  EXPECT_EQ(set.textOf(0, "text"), "one");
  EXPECT_EQ(set.textOf(1, "text"), "two");
  EXPECT_EQ(set.head().kind, "test");
}

TEST_F(PartSetTest, RefusesTwoContentsOfOneShard) {
  EXPECT_NE(
      whyNot({part("a", head(1, 1), "one"), part("b", head(1, 1), "two")}).find("is shard 1/1 as "),
      std::string::npos);
}

TEST_F(PartSetTest, TheMajorityDecidesWhoIsForeign) {
  const std::string why =
      whyNot({part("a", head(1, 3, R"({"seed":2})")), part("b", head(2, 3, R"({"seed":1})")),
              part("c", head(3, 3, R"({"seed":1})"))});
  EXPECT_EQ(why, (folder_ / "a").string() +
                     ": is of another job: seed is 2, that of the others 1\nmissing: 1/3");
}

TEST_F(PartSetTest, RefusesAnotherKindVersionAndNumberOfShards) {
  PartHead other = head(2, 2);
  other.kind = "other";
  EXPECT_NE(whyNot({part("a", head(1, 2)), part("b", other)}).find("is a part of `other`"),
            std::string::npos);
  PartHead older = head(2, 2);
  older.version = "0.0.1";
  EXPECT_NE(whyNot({part("a", head(1, 2)), part("b", older)}).find("made by version 0.0.1"),
            std::string::npos);
  older.shard = {1, 1};
  EXPECT_NE(whyNot({part("a", older)}).find(", this is "), std::string::npos);
  EXPECT_NE(whyNot({part("a", head(1, 2)), part("b", head(2, 3))}).find("the others are of 2"),
            std::string::npos);
}

TEST_F(PartSetTest, ReadsDigestsThatDifferOnlyWhereNamesAreTheSame) {
  test::writeBytes(folder_ / "input", "1");
  EXPECT_EQ(digestOfFile(folder_ / "input").size(), 32u);
  const std::string before = digestOfFile(folder_ / "input");
  test::writeBytes(folder_ / "input", "2");
  EXPECT_NE(digestOfFile(folder_ / "input"), before);
}

TEST_F(PartSetTest, RefusesHeadsThatMakeNoSense) {
  const auto written = [&](const std::string& json) {
    TableWriter writer(folder_ / "bad");
    writer.addText("part.json", json);
    writer.commit();
    return whyNot({folder_ / "bad"});
  };
  const std::string good =
      R"("format":"ortung part 1","kind":"k","version":"v","job":{},"needs":{},"inputs":{},"programs":{})";
  EXPECT_NE(written("").find("can't be read"), std::string::npos);
  EXPECT_NE(written("[]").find("is no part"), std::string::npos);
  EXPECT_NE(written(R"({"format":"ortung part 2"})").find("is no part"), std::string::npos);
  EXPECT_NE(written("{" + good + R"(,"shard":0,"shards":1})").find("does not exist"),
            std::string::npos);
  EXPECT_NE(written("{" + good + R"(,"shard":1,"shards":99999999999})").find("does not exist"),
            std::string::npos);
  EXPECT_NE(written("{" + good + R"(,"shard":"1","shards":1})").find("can't be read"),
            std::string::npos);
}

// Two builds of one version: a head tells of one library that is another one.
TEST_F(PartSetTest, RefusesPartsOfAnotherBuild) {
  const auto made = [&](const std::string& name, std::uint64_t number, const std::string& digest) {
    TableWriter writer(folder_ / name);
    writer.addText("part.json",
                   R"({"format":"ortung part 1","kind":"k","version":")" + PartHead::versionHere() +
                       R"(","job":{},"needs":{},"inputs":{},"programs":{"libortung_mcl.so":")" +
                       digest + R"("},"shard":)" + std::to_string(number) + R"(,"shards":3})");
    writer.commit();
    return folder_ / name;
  };
  EXPECT_EQ(whyNot({made("a", 1, "one"), made("b", 2, "one"), made("c", 3, "one")}), "");
  EXPECT_EQ(whyNot({made("a", 1, "one"), made("b", 2, "one"), made("d", 3, "two")}),
            (folder_ / "d").string() +
                ": was made by another libortung_mcl.so than the others (digest two, not one)\n"
                "missing: 3/3");
}

TEST_F(PartSetTest, KnowTheLibrariesThatMadeThem) {
  const PartSet set({part("a", head(1, 1))});
  const auto container = set.head().programs.lower_bound("libortung_container.so");
  ASSERT_NE(container, set.head().programs.end());
  EXPECT_TRUE(container->first.starts_with("libortung_container.so")) << container->first;
  for (const auto& [name, digest] : set.head().programs)
    EXPECT_EQ(digestOfProgramFile(name), digest) << name;
  EXPECT_EQ(digestOfProgramFile("libortung_nobody.so"), "missing");
  EXPECT_EQ(digestOfProgramFile("../lib/" + container->first), "missing");
}

TEST_F(PartSetTest, RunsMustBeTheirShards) {
  KeptRun run{"{}", {}, {}};
  write({{1}, {run}}, head(1, 2), folder_ / "a");
  write({{0}, {run}}, head(2, 2), folder_ / "b");
  EXPECT_THROW(mergeEvaluated(PartSet({folder_ / "a", folder_ / "b"})), PartError);
  write({{0}, {run}}, head(1, 2), folder_ / "a");
  write({{3}, {run}}, head(2, 2), folder_ / "b");
  EXPECT_THROW(mergeEvaluated(PartSet({folder_ / "a", folder_ / "b"})), PartError) << "1 and 2?";
}

TEST_F(PartSetTest, PicturesStayInTheirFolder) {
  for (const std::string name :
       {"../escaped.png", "/tmp/escaped.png", "images/../../escaped.png", "a/b/c.png", ""}) {
    PartWriter writer(folder_ / "p", {"images", "{}", {1, 1}});
    addLongText(writer.content(), "file.000000", "bytes");
    addLongText(writer.content(), "list", R"({"files":[")" + name + R"("],"pictures":[]})");
    writer.commit();
    EXPECT_THROW(mergePictures(PartSet({folder_ / "p"}), folder_ / "out", true), PartError) << name;
  }
  EXPECT_FALSE(fs::exists(folder_ / "escaped.png"));
}

TEST(Shards, AreReadFromText) {
  EXPECT_EQ(readShard("2/7"), (Shard{2, 7}));
  EXPECT_EQ(toText(readShard("1/1000000")), "1/1000000");
  for (const char* bad : {"", "1", "0/1", "2/1", "1/0", "a/b", "1/2/3", "-1/2", "1/1000001", "1 /2",
                          "18446744073709551617/2"})
    EXPECT_THROW(readShard(bad), UsageError) << bad;
}

TEST(Shards, HaveEachUnitOnce) {
  for (std::uint64_t unit = 0; unit < 100; ++unit) {
    int owners = 0;
    for (std::uint64_t i = 1; i <= 7; ++i) owners += Shard{i, 7}.has(unit) ? 1 : 0;
    EXPECT_EQ(owners, 1);
  }
}

}  // namespace
}  // namespace ortung::app
