/// MCAP files written byte by byte, and what a reader finds by the summary of one.
#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <cstring>
#include <sstream>

#include "ortung/ros2/McapReader.hpp"
#include "ortung/ros2/McapWriter.hpp"

namespace ortung::ros2 {
namespace {

using namespace std::string_literals;
using Texts = std::vector<std::string>;

const std::string kMagic = "\x89MCAP0\r\n"s;

template <class T>
std::string number(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}
std::string u16(std::uint16_t value) { return number(value); }
std::string u32(std::uint32_t value) { return number(value); }
std::string u64(std::uint64_t value) { return number(value); }
std::string text(const std::string& value) {
  return u32(static_cast<std::uint32_t>(value.size())) + value;
}
std::string record(int kind, const std::string& content) {
  return std::string(1, static_cast<char>(kind)) + u64(content.size()) + content;
}
std::uint32_t crcOf(const std::string& bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

const std::string kHeader = record(1, text("ros2") + text("test"));
const std::string kSchema = record(3, u16(1) + text("p/msg/T") + text("ros2msg") + text("int8 x"));
const std::string kChannel = record(4, u16(5) + u16(1) + text("/a") + text("cdr") + text(""));

std::string message(std::uint16_t channel, std::uint64_t time, const std::string& data) {
  return record(5, u16(channel) + u32(0) + u64(time) + u64(time + 1) + data);
}
std::string chunk(const std::string& records, std::uint32_t crc, std::uint64_t size) {
  return record(6,
                u64(0) + u64(0) + u64(size) + u32(crc) + text("") + u64(records.size()) + records);
}
std::string chunk(const std::string& records) {
  return chunk(records, crcOf(records), records.size());
}

/// What is read: time, topic and data of each message.
Texts read(const std::string& bytes) {
  std::istringstream in(bytes);
  McapReader reader(in, "x.mcap");
  Texts found;
  for (McapMessage one; reader.next(one);)
    found.push_back(std::to_string(one.logTime) + " " + one.channel->topic + " " +
                    std::string(one.data));
  return found;
}

/// Why it can't be read, behind the file's name.
std::string complaint(const std::string& records) {
  try {
    read(kMagic + records);
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    EXPECT_TRUE(what.starts_with("x.mcap: found ")) << what;
    return what.substr(std::min<std::size_t>(what.size(), 14));
  }
  return "";
}

TEST(McapBytes, AFileOfTheSpecificationIsRead) {
  const std::string records = kSchema + kChannel + message(5, 70, "one") + message(5, 60, "");
  EXPECT_EQ(read(kMagic + kHeader + records + record(15, u32(0)) + "whatever"),
            (Texts{"70 /a one", "60 /a "}));
  EXPECT_EQ(read(kMagic + kHeader + chunk(records)), (Texts{"70 /a one", "60 /a "}));
  EXPECT_EQ(read(kMagic + kHeader + chunk(records, 0, records.size())).size(), 2u)
      << "a checksum of 0 says nothing";
}

// Kinds that later versions add, and those that are not needed, are passed over.
TEST(McapBytes, OtherRecordsArePassedOver) {
  const std::string other = record(7, "index") + record(12, "metadata") + record(200, "private");
  EXPECT_EQ(read(kMagic + kHeader + other + kSchema + other + kChannel +
                 chunk(record(129, "?") + message(5, 1, "x") + record(9, "no attachment"))),
            (Texts{"1 /a x"}));
  EXPECT_NE(complaint(record(0, "")).find("a record of kind 0 at byte 8, expected 1 to 15"),
            std::string::npos);
}

TEST(McapBytes, AChannelOfNoSchemaIsOne) {
  EXPECT_EQ(read(kMagic + record(4, u16(2) + u16(0) + text("/j") + text("json") + text("")) +
                 message(2, 3, "{}")),
            (Texts{"3 /j {}"}));
}

TEST(McapBytes, ChannelsAreRepeatedButNotChanged) {
  const std::string start = kSchema + kChannel;
  EXPECT_EQ(complaint(start + kSchema + kChannel), "");
  EXPECT_EQ(
      complaint(start + record(4, u16(5) + u16(1) + text("/b") + text("cdr") + text(""))),
      "channel 5 for /b at byte " + std::to_string(8 + start.size()) + ", expected it to stay /a");
  EXPECT_NE(complaint(start + record(4, u16(5) + u16(1) + text("/a") + text("json") + text(""))),
            "");
  EXPECT_EQ(complaint(kChannel),
            "channel /a of schema 1 at byte 8, expected a schema that came "
            "before");
  EXPECT_EQ(complaint(message(5, 1, "")),
            "a message of channel 5 at byte 8, expected a channel that came before");
}

TEST(McapBytes, RecordsThatAreTooShortAreRefused) {
  for (const auto& [bytes, what] :
       {std::pair{record(1, u32(9) + "ros2"), "a header that is too short"},
        {record(3, u16(1) + text("p") + text("ros2msg")), "a schema that is too short"},
        {kSchema + record(4, u16(5) + u16(1) + text("/a") + text("cdr")),
         "a channel that is too short"},
        {kSchema + record(4, u16(5) + u16(1) + text("/a") + text("cdr") + text("\1")),
         "a channel whose metadata is truncated"},
        {kSchema + kChannel + record(5, u16(5) + u32(0) + u64(1) + "1234567"),
         "a message that is too short"},
        {record(6, u64(0) + u64(0) + u64(4) + u32(0) + text("") + u64(5) + "1234"),
         "a chunk that is too short"},
        {record(9, u64(0) + u64(0) + text("n") + text("t") + u64(9) + "12345678"),
         "an attachment that is too short"},
        {record(9, u64(0) + u64(0) + text("n") + text("t") + u64(4) + "1234" + "567"),
         "an attachment without a checksum"},
        {chunk(kSchema + "\4" + u64(99)), "a record that does not end within its chunk"}})
    EXPECT_TRUE(complaint(bytes).starts_with(what)) << complaint(bytes) << " for " << what;
}

TEST(McapBytes, ChunksAreAsLongAsTheySay) {
  const std::string records = kSchema + kChannel;
  EXPECT_EQ(complaint(chunk(records, 0, records.size() + 1)),
            "a chunk of " + std::to_string(records.size()) + " bytes at byte 8, expected the " +
                std::to_string(records.size() + 1) + " that it announces");
  EXPECT_EQ(complaint(chunk("", 0, McapReader::kMostBytes + 1)),
            "a chunk of 134217729 bytes at byte 8, expected 134217728 at most");
  EXPECT_TRUE(complaint(chunk(records, 1, records.size())).starts_with("a damaged chunk"));
}

TEST(McapBytes, AttachmentsHaveAChecksumUnlessItIsZero) {
  const std::string content = u64(1) + u64(2) + text("robot.toml") + text("t") + u64(3) + "abc";
  const auto attached = [&](std::uint32_t crc) {
    std::istringstream in(kMagic + kHeader + record(9, content + u32(crc)));
    McapReader reader(in, "x.mcap");
    McapMessage none;
    EXPECT_FALSE(reader.next(none));
    return reader.attachments();
  };
  EXPECT_EQ(attached(crcOf(content)).at("robot.toml"), "abc");
  EXPECT_EQ(attached(0).at("robot.toml"), "abc");
  EXPECT_THROW(attached(1), std::runtime_error);
}

// --- by the summary: the parts that a player needs to seek ---

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return value;
}
/// The content of the record at a place. @param length of the whole record
std::string contentAt(const std::string& bytes, std::size_t at, int kind, std::size_t* length) {
  EXPECT_EQ(bytes.at(at++), static_cast<char>(kind));
  const auto size = take<std::uint64_t>(bytes, at);
  *length = 9 + size;
  return bytes.substr(at, size);
}

/// A finished file: two channels, three messages, an attachment; each message ends a chunk.
std::string finished() {
  std::string bytes;
  McapWriter writer([&](std::string_view piece) { bytes += piece; },
                    {.compression = McapCompression::kNone, .chunkBytes = 1});
  const auto schema = writer.addSchema("p/msg/T", "ros2msg", "int8 x");
  const auto a = writer.addChannel(schema, "/a", "cdr", {});
  const auto b = writer.addChannel(schema, "/b", "cdr", {});
  writer.write(a, 500, "first");
  writer.attach("n.txt", "text/plain", "hello");
  writer.write(b, 300, "second");
  writer.write(a, 400, "third");
  writer.finish();
  writer.finish();  // once is enough
  return bytes;
}

/// The footer's numbers.
struct Footer {
  explicit Footer(const std::string& bytes) {
    std::size_t at = bytes.size() - 8 - 20;
    begin = at - 9;
    summary = take<std::uint64_t>(bytes, at);
    offsets = take<std::uint64_t>(bytes, at);
    crc = take<std::uint32_t>(bytes, at);
  }
  std::size_t begin = 0;
  std::uint64_t summary = 0, offsets = 0;
  std::uint32_t crc = 0;
};

TEST(McapSummary, EndsWithTheFooterWhoseChecksumCoversTheSummary) {
  const std::string bytes = finished();
  ASSERT_TRUE(bytes.starts_with(kMagic));
  ASSERT_TRUE(bytes.ends_with(kMagic));
  const Footer footer(bytes);
  EXPECT_EQ(bytes[footer.begin], '\2');
  const std::size_t covered = footer.begin + 9 + 16 - footer.summary;
  EXPECT_EQ(footer.crc, crcOf(bytes.substr(footer.summary, covered)));
  // Before it the data end, with a checksum of all that came so far.
  std::size_t length = 0;
  const std::size_t end = footer.summary - 13;
  EXPECT_EQ(contentAt(bytes, end, 15, &length), u32(crcOf(bytes.substr(0, end))));
}

TEST(McapSummary, OffsetsLeadToTheGroupsOfRecords) {
  const std::string bytes = finished();
  const Footer footer(bytes);
  std::map<int, std::pair<std::uint64_t, std::uint64_t>> groups;
  for (std::size_t at = footer.offsets; at < footer.begin;) {
    std::size_t length = 0;
    const std::string content = contentAt(bytes, at, 14, &length);
    std::size_t in = 1;
    const auto begin = take<std::uint64_t>(content, in);
    groups[content[0]] = {begin, take<std::uint64_t>(content, in)};
    at += length;
  }
  ASSERT_EQ(groups.size(), 5u);  // schemas, channels, chunk indexes, attachment indexes, statistics
  std::uint64_t next = footer.summary;
  for (const int kind : {3, 4, 11, 8, 10}) {
    ASSERT_TRUE(groups.contains(kind)) << kind;
    EXPECT_EQ(groups[kind].first, next) << kind;
    EXPECT_EQ(bytes[next], static_cast<char>(kind));
    next += groups[kind].second;
  }
  EXPECT_EQ(next, footer.offsets);
  // Statistics: 3 messages, 1 schema, 2 channels, 1 attachment, no metadata, 3 chunks, 300 to 500
  // ns; 2 messages of channel 0, 1 of channel 1.
  std::size_t length = 0;
  EXPECT_EQ(contentAt(bytes, groups[11].first, 11, &length),
            u64(3) + u16(1) + u32(2) + u32(1) + u32(0) + u32(3) + u64(300) + u64(500) + u32(20) +
                u16(0) + u64(2) + u16(1) + u64(1));
  // The attachment: where it is, no times, 5 bytes, its name and type.
  const std::string index = contentAt(bytes, groups[10].first, 10, &length);
  std::size_t at = 0;
  const auto place = take<std::uint64_t>(index, at);
  const auto size = take<std::uint64_t>(index, at);
  EXPECT_EQ(index.substr(at), u64(0) + u64(0) + u64(5) + text("n.txt") + text("text/plain"));
  contentAt(bytes, place, 9, &length);
  EXPECT_EQ(length, size);
}

TEST(McapSummary, AChunksIndexLeadsToEachOfItsMessages) {
  const std::string bytes = finished();
  const Footer footer(bytes);
  Texts found;
  std::size_t at = footer.summary;
  for (std::size_t length = 0; at < footer.offsets; at += length) {
    std::size_t head = at + 1;
    length = 9 + take<std::uint64_t>(bytes, head);
    if (bytes[at] != 8) continue;
    std::size_t in = at + 9;
    const auto first = take<std::uint64_t>(bytes, in);
    EXPECT_EQ(take<std::uint64_t>(bytes, in), first);  // one message a chunk
    const auto chunkAt = take<std::uint64_t>(bytes, in);
    const auto chunkLength = take<std::uint64_t>(bytes, in);
    EXPECT_EQ(take<std::uint32_t>(bytes, in), 10u);  // one channel: its number, its index' place
    const auto channel = take<std::uint16_t>(bytes, in);
    const auto indexAt = take<std::uint64_t>(bytes, in);
    EXPECT_EQ(indexAt, chunkAt + chunkLength);
    std::size_t indexLength = 0;
    const std::string index = contentAt(bytes, indexAt, 7, &indexLength);
    EXPECT_EQ(take<std::uint64_t>(bytes, in), indexLength);
    ASSERT_EQ(index.size(), 2u + 4u + 16u);
    EXPECT_EQ(index.substr(0, 14), u16(channel) + u32(16) + u64(first));
    std::size_t last = 14;
    const auto offset = take<std::uint64_t>(index, last);
    std::size_t ignored = 0;
    const std::string content = contentAt(bytes, chunkAt, 6, &ignored);
    // Behind times, size, checksum, an empty compression and the size lie the records.
    const std::string records = content.substr(8 + 8 + 8 + 4 + 4 + 8);
    const std::string found1 = contentAt(records, offset, 5, &ignored);
    EXPECT_EQ(found1.substr(0, 2), u16(channel));
    found.push_back(found1.substr(22));
  }
  EXPECT_EQ(found, (Texts{"first", "second", "third"}));
}

// A channel's messages are numbered from 0 on, each for itself.
TEST(McapSummary, MessagesAreNumberedByChannel) {
  std::string bytes;
  McapWriter writer([&](std::string_view piece) { bytes += piece; }, {.isChunked = false});
  const auto a = writer.addChannel(0, "/a", "cdr", {});
  const auto b = writer.addChannel(0, "/b", "cdr", {});
  for (const auto channel : {a, b, a}) writer.write(channel, 7, "x");
  EXPECT_NE(bytes.find(u16(0) + u32(0) + u64(7) + u64(7) + "x"), bytes.npos);
  EXPECT_NE(bytes.find(u16(1) + u32(0) + u64(7) + u64(7) + "x"), bytes.npos);
  EXPECT_NE(bytes.find(u16(0) + u32(1) + u64(7) + u64(7) + "x"), bytes.npos);
}

TEST(McapSummary, AFileWithoutMessagesHasNoTimes) {
  std::string bytes;
  McapWriter writer([&](std::string_view piece) { bytes += piece; }, {.profile = "x"});
  writer.finish();
  EXPECT_TRUE(bytes.starts_with(kMagic + record(1, text("x") + text("ortung"))));
  const Footer footer(bytes);
  std::size_t length = 0;
  EXPECT_EQ(contentAt(bytes, footer.summary, 11, &length),
            u64(0) + u16(0) + u32(0) + u32(0) + u32(0) + u32(0) + u64(0) + u64(0) + u32(0));
  EXPECT_TRUE(read(bytes).empty());
}

}  // namespace
}  // namespace ortung::ros2
