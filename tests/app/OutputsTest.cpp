#include <gtest/gtest.h>

#include <string>

#include "Console.hpp"
#include "Files.hpp"
#include "Outputs.hpp"
#include "ortung/base/InputFile.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;
using test::messageOf;
using test::readBytes;
using test::TemporaryFolder;
using test::writeBytes;

template <class Error>
std::string refusal(const fs::path& file, OutputKind kind, bool force = false) {
  return messageOf<Error>([&] { Outputs(force).writes("--out", file, kind); });
}

TEST(Outputs, ReplaceAFileOfTheirKindAndLeaveNothingElse) {
  const TemporaryFolder folder;
  writeBytes(folder / "poses.txt", "# stamp_us x_m\nold");
  Outputs outputs(false);
  outputs.writes("--out", folder / "poses.txt", OutputKind::kPoses);
  outputs.write(folder / "poses.txt", "new");
  EXPECT_EQ(readBytes(folder / "poses.txt"), "new");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(Outputs, NameTheMissingFolderBeforeWorkBegins) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal<std::runtime_error>(folder / "none" / "a", OutputKind::kPoses),
            (folder / "none" / "a").string() + ": can't be written: there is no folder " +
                (folder / "none").string());
  EXPECT_EQ(refusal<std::runtime_error>(folder.path(), OutputKind::kPoses, true),
            folder.path().string() + ": is a folder, expected a file");
  EXPECT_EQ(refusal<std::runtime_error>(folder / "a" / "", OutputKind::kPoses),
            (folder / "a" / "").string() + ": names a folder, expected a file");
  EXPECT_EQ(refusal<std::runtime_error>(folder / "a", OutputKind::kPoses), "(nothing was thrown)");
  EXPECT_EQ(folder.files(), 0u) << "nothing is made by looking";
}

TEST(Outputs, OfAnotherKindAreReplacedByForceOnly) {
  const TemporaryFolder folder;
  const std::string samples[] = {
      "# ortung record 1\n",
      "PK\x03\x04 ... open.npy",
      "PK\x03\x04 ... ortung-part.txt",
      "{\n  \"source\": \"x\", \"compared_steps\": 3",
      "{\n  \"pairs\": 10,",
      "<!DOCTYPE html>",
      "\x89PNG\r\n\x1a\n",
      "# stamp_us x_m y_m",
      "{\"stamp_us\":0,\"x_m\":1.0",
      "# timestamp tx ty tz qx qy qz qw\n",
      "PK\x03\x04 ... stamp_us.npy",
      "time_s,kind,name,x_m",
      "# Learned by `ortung learn-motion` from",
      "{\n \"commands\": 5, \"format\": \"ortung motion network 1\"",
  };
  constexpr int kKinds = 14;
  for (int content = 0; content < kKinds; ++content) {
    for (int kind = 0; kind <= kKinds; ++kind) {  // the last one is never replaced unasked
      writeBytes(folder / "a", samples[content]);
      const std::string told =
          refusal<std::runtime_error>(folder / "a", static_cast<OutputKind>(kind));
      EXPECT_EQ(told == "(nothing was thrown)", content == kind) << content << " " << kind << told;
      EXPECT_EQ(told.find("--force") == std::string::npos, content == kind) << told;
      EXPECT_EQ(refusal<std::runtime_error>(folder / "a", static_cast<OutputKind>(kind), true),
                "(nothing was thrown)");
    }
  }
  writeBytes(folder / "a", "[robot]\nname = \"scout\"\n");
  EXPECT_EQ(refusal<std::runtime_error>(folder / "a", OutputKind::kTables),
            (folder / "a").string() +
                ": exists and is not what --out writes (tables); it would be overwritten; "
                "use --force");
  writeBytes(folder / "a", "");
  EXPECT_EQ(refusal<std::runtime_error>(folder / "a", OutputKind::kTables), "(nothing was thrown)");
}

TEST(Outputs, NeverReplaceWhatTheRunReadsByWhateverName) {
  const TemporaryFolder folder;
  writeBytes(folder / "run.rec", "# ortung record 1\n");
  fs::create_symlink("run.rec", folder / "link");
  fs::create_hard_link(folder / "run.rec", folder / "hard");
  for (const char* name : {"run.rec", "link", "hard"}) {
    Outputs outputs(true);
    outputs.readsSource("record:" + (folder / "run.rec").string() + "?speed=2");
    EXPECT_EQ(messageOf<UsageError>(
                  [&] { outputs.writes("--record", folder / name, OutputKind::kRecord); }),
              (folder / name).string() +
                  ": is read by this run, so --record can't overwrite it; name another file");
  }
}

// A map that a world names is known as an input when the world is read, not before.
TEST(Outputs, DoNotReplaceWhatWasReadSinceTheyWereDeclared) {
  const TemporaryFolder folder;
  writeBytes(folder / "map.png", "\x89PNG\r\n\x1a\n");
  Outputs outputs(true);
  outputs.writes("--out", folder / "map.png", OutputKind::kPicture);
  std::string why;
  openInput(folder / "map.png", why);
  EXPECT_NE(messageOf<UsageError>([&] {
              outputs.write(folder / "map.png", "x");
            }).find("is read by this run"),
            std::string::npos);
  EXPECT_EQ(readBytes(folder / "map.png"), "\x89PNG\r\n\x1a\n");
}

TEST(Outputs, AreDifferentFiles) {
  const TemporaryFolder folder;
  fs::create_symlink("a", folder / "link");
  const auto two = [&](const fs::path& one, const fs::path& other) {
    Outputs outputs(true);
    outputs.writes("--json", one, OutputKind::kFigures);
    return messageOf<UsageError>([&] { outputs.writes("--report", other, OutputKind::kReport); });
  };
  EXPECT_NE(two(folder / "a", folder / "link").find("--json and --report name the same file"),
            std::string::npos);
  EXPECT_EQ(two(folder / "a", folder / "b"), "(nothing was thrown)");
  EXPECT_EQ(two("/dev/null", "/dev/null"), "(nothing was thrown)");
}

TEST(Outputs, MayBeDevicesButNoDiskUnasked) {
  EXPECT_EQ(refusal<std::runtime_error>("/dev/null", OutputKind::kTables), "(nothing was thrown)");
  EXPECT_EQ(refusal<std::runtime_error>("/dev/stdout", OutputKind::kTables),
            "(nothing was thrown)");
  for (const auto& entry : fs::directory_iterator("/dev")) {
    if (!entry.is_block_file()) continue;
    EXPECT_NE(refusal<std::runtime_error>(entry.path(), OutputKind::kTables).find("is a disk"),
              std::string::npos);
    return;
  }
}

}  // namespace
}  // namespace ortung::app
