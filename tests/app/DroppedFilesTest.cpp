#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <future>
#include <iterator>

#include "Await.hpp"
#include "DroppedFiles.hpp"
#include "Files.hpp"

namespace ortung::app {
namespace {

constexpr const char* kRecord =
    "# ortung record 1\n"
    "0 odometry/odometry/pose 5 2147483648 2147483648 18000 2147483648 2147483648\n"
    "100000 odometry/odometry/pose 5 2147483748 2147483648 18000 2147483648 2147483648\n"
    "200000 odometry/odometry/pose 5 2147483848 2147483648 18000 2147483648 2147483648\n";

/// Files for a page that shows a record; temporary folders are in one that the test looks into.
class DroppedFilesTest : public testing::Test {
 protected:
  DroppedFilesTest() {
    ::setenv("TMPDIR", folder_.path().c_str(), 1);
    shown_.sources = {"first.rec"};
  }
  ~DroppedFilesTest() override { ::unsetenv("TMPDIR"); }

  std::size_t kept() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_.path()),
                      std::filesystem::directory_iterator()));
  }
  /// Sends a file in pieces. @returns what is said to who sent it
  static WebReply send(const WebUploads& uploads, const std::string& target,
                       const std::string& bytes) {
    WebReply refusal;
    const auto upload = uploads.begin(target, refusal);
    if (!upload) return refusal;
    constexpr std::size_t kPiece = 1000;
    for (std::size_t at = 0; at < bytes.size(); at += kPiece)
      if (auto refused = upload->take(std::string_view(bytes).substr(at, kPiece))) return *refused;
    std::promise<WebReply> said;
    upload->finish([&](const WebReply& reply) { said.set_value(reply); });
    return said.get_future().get();
  }

  test::TemporaryFolder folder_;
  ViewArguments shown_;
};

TEST_F(DroppedFilesTest, ARecordIsReadyToBeShownAloneOrBesideOthers) {
  DroppedFiles files(shown_);
  const WebUploads uploads = files.uploads();
  EXPECT_FALSE(files.isReady());
  EXPECT_EQ(files.take(), nullptr);
  const WebReply reply = send(uploads, "/open?name=mine.rec", kRecord);
  EXPECT_EQ(reply.status, 200u) << reply.text;
  EXPECT_EQ(reply.text, "opened mine.rec");
  ASSERT_TRUE(files.isReady());
  auto alone = files.take();
  ASSERT_NE(alone, nullptr);
  EXPECT_FALSE(files.isReady());
  ASSERT_EQ(alone->world().residents().size(), 1u);
  EXPECT_EQ(alone->world().residents().front().name, "mine");
  EXPECT_EQ(send(uploads, "/open?name=other.rec&beside=1", kRecord).status, 200u);
  const auto both = files.take();
  ASSERT_EQ(both->world().residents().size(), 2u);
  EXPECT_EQ(both->world().residents().back().name, "other");
}

TEST_F(DroppedFilesTest, SaysWhatIsNoRecordAndKeepsNothingOfIt) {
  DroppedFiles files(shown_);
  const WebUploads uploads = files.uploads();
  const auto said = [&](const std::string& name, const std::string& bytes) {
    const WebReply reply = send(uploads, "/open?name=" + name, bytes);
    return std::to_string(reply.status) + " " + reply.text;
  };
  const std::string robot = said("my.toml", "[robot]\nradius_m = 0.25\n");
  EXPECT_TRUE(robot.starts_with("415 my.toml is a robot file (for --robot); expected a record"))
      << robot;
  EXPECT_TRUE(said("a.html", "<!doctype html><html></html>").starts_with("415 a.html is a page"));
  EXPECT_TRUE(said("none.rec", "").starts_with("415 none.rec is of no kind"));
  EXPECT_TRUE(said("noise.rec", std::string(5000, '\7')).starts_with("415 noise.rec"));
  const std::string bad = said("bad.rec", "# ortung record 1\nnonsense\n");
  EXPECT_TRUE(bad.starts_with("422 bad.rec")) << bad;
  EXPECT_EQ(bad.find(folder_.path().string()), bad.npos) << bad;
  EXPECT_FALSE(files.isReady());
  EXPECT_TRUE(test::comesTrue("nothing is kept", [&] { return kept() == 0; }));
}

TEST_F(DroppedFilesTest, TakesOnlyPlainNames) {
  DroppedFiles files(shown_);
  const WebUploads uploads = files.uploads();
  for (const char* query :
       {"", "?", "?name=", "?name=../a", "?name=a/b", "?name=.hidden", "?name=a%2Fb", "?name=a b",
        "?beside=1", "?name=a&what=1", "?name=a&beside=2"})
    EXPECT_EQ(send(uploads, std::string("/open") + query, "x").status, 400u) << query;
  EXPECT_EQ(send(uploads, "/open?name=" + std::string(101, 'a'), "x").status, 400u);
  EXPECT_EQ(kept(), 0u);
}

TEST_F(DroppedFilesTest, TakesOneAtATimeAndNothingIsLeftOfOneThatIsCut) {
  DroppedFiles files(shown_);
  const WebUploads uploads = files.uploads();
  WebReply refusal;
  auto cut = uploads.begin("/open?name=a.rec", refusal);
  ASSERT_NE(cut, nullptr);
  EXPECT_EQ(cut->take("the beginning"), std::nullopt);
  EXPECT_EQ(send(uploads, "/open?name=b.rec", "x").status, 409u);
  EXPECT_EQ(kept(), 1u);
  cut.reset();
  EXPECT_EQ(kept(), 0u);
  EXPECT_EQ(send(uploads, "/open?name=b.rec", kRecord).status, 200u);
  EXPECT_EQ(send(uploads, "/open?name=c.rec", "x").status, 409u);  // until that one is shown
}

TEST_F(DroppedFilesTest, TakesNoneWithoutRoomForAny) {
  shown_.dropLimit = 0;
  EXPECT_FALSE(DroppedFiles(shown_).uploads().begin);
  shown_.dropLimit = 7;
  EXPECT_EQ(DroppedFiles(shown_).uploads().most, 7'000'000u);
}

}  // namespace
}  // namespace ortung::app
