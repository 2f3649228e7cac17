#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "ortung/ros2/McapReader.hpp"
#include "ortung/ros2/McapWriter.hpp"

namespace ortung::ros2 {
namespace {

using Options = McapWriter::Options;
using Texts = std::vector<std::string>;

constexpr int kMessages = 40;

/// Messages "0" to "39" in turn on two topics, and a file; chunks of five messages or so.
std::string fileWith(Options options, bool isFinished = true) {
  std::string bytes;
  options.chunkBytes = 200;
  McapWriter writer([&](std::string_view piece) { bytes += piece; }, options);
  const auto schema = writer.addSchema("pkg/msg/Text", "ros2msg", "string text\n");
  std::uint16_t channels[2];
  for (const char* topic : {"/a", "/b"})
    channels[topic[1] - 'a'] = writer.addChannel(schema, topic, "cdr", {{"key", topic}});
  writer.attach("note.txt", "text/plain", "hello");
  for (int i = 0; i < kMessages; ++i)
    writer.write(channels[i % 2], static_cast<std::uint64_t>(i) * 10, std::to_string(i));
  EXPECT_EQ(writer.messages(), kMessages);
  if (isFinished) writer.finish();
  return bytes;
}

/// What a reader makes of it: topics and messages.
Texts read(const std::string& bytes, bool* isUnfinished = nullptr) {
  std::istringstream in(bytes);
  McapReader reader(in, "x.mcap");
  Texts found;
  for (McapMessage message; reader.next(message);)
    found.push_back(message.channel->topic + std::string(message.data));
  if (isUnfinished != nullptr) *isUnfinished = reader.isUnfinished();
  return found;
}

std::string errorOf(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

Texts all() {
  Texts texts;
  for (int i = 0; i < kMessages; ++i)
    texts.push_back((i % 2 == 0 ? "/a" : "/b") + std::to_string(i));
  return texts;
}

const Options kKinds[] = {{.compression = McapCompression::kNone},
                          {.compression = McapCompression::kLz4},
                          {.compression = McapCompression::kZstd},
                          {.isChunked = false}};

TEST(Mcap, ComesBackWhateverTheCompression) {
  for (const Options& kind : kKinds) {
    bool isUnfinished = true;
    const std::string bytes = fileWith(kind);
    EXPECT_EQ(read(bytes, &isUnfinished), all());
    EXPECT_FALSE(isUnfinished);
  }
}

TEST(Mcap, ChannelsKnowTheirSchemaAndMetadataAndFilesWithinAreFound) {
  std::istringstream in(fileWith({}));
  McapReader reader(in, "x.mcap");
  McapMessage message;
  ASSERT_TRUE(reader.next(message));
  EXPECT_EQ(reader.profile(), "ros2");
  EXPECT_EQ(message.channel->encoding, "cdr");
  EXPECT_EQ(message.channel->schema.name, "pkg/msg/Text");
  EXPECT_EQ(message.channel->schema.text, "string text\n");
  EXPECT_EQ(message.channel->metadata.at("key"), "/a");
  ASSERT_TRUE(reader.next(message));
  EXPECT_EQ(message.logTime, 10u);
  while (reader.next(message)) {
  }
  EXPECT_EQ(reader.attachments().at("note.txt"), "hello");
}

TEST(Mcap, AFileThatEndsAnywhereIsReadUpToThere) {
  for (const Options& kind : kKinds) {
    const std::string whole = fileWith(kind);
    const Texts everything = all();
    std::size_t most = 0;
    for (std::size_t size = 8; size < whole.size(); ++size) {
      bool isUnfinished = false;
      const Texts found = read(whole.substr(0, size), &isUnfinished);
      EXPECT_TRUE(std::equal(found.begin(), found.end(), everything.begin())) << size;
      EXPECT_GE(found.size(), most) << size;
      most = found.size();
      EXPECT_TRUE(isUnfinished || found.size() == everything.size()) << size;
    }
    EXPECT_EQ(most, everything.size());
  }
}

TEST(Mcap, AnUnfinishedFileLosesItsLastChunkAtMost) {
  bool isUnfinished = false;
  const Texts found = read(fileWith({}, false), &isUnfinished);
  EXPECT_TRUE(isUnfinished);
  EXPECT_GT(found.size(), kMessages - 10u);
}

TEST(Mcap, SaysWhatIsDamaged) {
  const std::string whole = fileWith({.compression = McapCompression::kNone});
  EXPECT_EQ(
      errorOf("hello, I am no such file"),
      "x.mcap: found another beginning at byte 0, expected that of an MCAP file of version 0");
  std::string changed = whole;
  changed[changed.find("string text") + 2] = 'x';
  EXPECT_NE(errorOf(changed).find("found a damaged chunk"), std::string::npos) << errorOf(changed);
  std::string unknown = fileWith({.compression = McapCompression::kLz4});
  unknown.replace(unknown.find("lz4"), 3, "lzo");
  EXPECT_NE(errorOf(unknown).find("compressed with 'lzo'"), std::string::npos) << errorOf(unknown);
}

TEST(Mcap, NoDamageDoesMoreThanEndTheReading) {
  std::mt19937 random(1);
  for (const Options& kind : kKinds) {
    const std::string whole = fileWith(kind);
    for (int i = 0; i < 2000; ++i) {
      std::string bytes = whole;
      for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      errorOf(bytes);  // throws nothing else
    }
  }
}

}  // namespace
}  // namespace ortung::ros2
