#include "ortung/ros2/McapReader.hpp"

#include <stdexcept>
#include <utility>

#include "Compression.hpp"
#include "McapBytes.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::uint64_t kMostAttachment = 1U << 20;  // bytes
constexpr std::size_t kMostAttachments = 64;
constexpr std::uint64_t kRecordHead = 9;  // bytes: kind and length

struct Record {
  McapOp kind{};
  std::string_view content;
};

/// Takes the next record within a chunk.
bool takeRecord(std::string_view& bytes, Record& record) {
  std::uint8_t kind = 0;
  if (!take(bytes, kind)) return false;
  record.kind = static_cast<McapOp>(kind);
  return takeBytes<std::uint64_t>(bytes, record.content);
}

}  // namespace

struct McapReader::Parts {
  std::istream& file;
  std::string name;
  std::uint64_t size = 0;
  std::uint64_t at = 0;     ///< number of bytes read
  std::uint64_t place = 0;  ///< place of the current record [bytes]
  std::string profile;
  std::string record;  ///< content of a record outside chunks
  std::string chunk;
  std::string_view rest;  ///< rest of the chunk
  std::map<std::uint16_t, McapSchema> schemas;
  std::map<std::uint16_t, McapChannel> channels;
  std::map<std::string, std::string> attachments;
  bool isUnfinished = false;
  bool isOver = false;

  Parts(std::istream& in, std::string named) : file(in), name(std::move(named)) {
    file.seekg(0, std::ios::end);
    const std::streamoff end = file.tellg();
    file.seekg(0);
    size = end > 0 ? static_cast<std::uint64_t>(end) : 0;
    std::string magic(kMcapMagic.size(), '\0');
    if (!read(magic) || magic != kMcapMagic)
      fail("another beginning", "that of an MCAP file of version 0");
  }
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw std::runtime_error(name + ": found " + found + " at byte " + std::to_string(place) +
                             ", expected " + expected);
  }
  bool read(std::string& bytes) {
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (file.bad()) fail("bytes that can't be read", "the file's");
    at += static_cast<std::uint64_t>(file.gcount());
    return static_cast<std::size_t>(file.gcount()) == bytes.size();
  }
  void pass(std::uint64_t count) {
    file.seekg(static_cast<std::streamoff>(count), std::ios::cur);
    at += count;
  }
  /// Reads the next record that is used; false at the end of the file.
  bool readRecord(McapOp& kind);
  bool isWanted(McapOp kind, std::uint64_t length) const;

  void takeHeader();
  void takeSchema(std::string_view content);
  void takeChannel(std::string_view content);
  void takeChunk(std::string_view content);
  void takeAttachment(std::string_view content);
  bool takeMessage(std::string_view content, McapMessage& message) const;
  /// Takes a record. @returns whether it is a message
  bool look(const Record& one, McapMessage& message);
  void unpack(std::string_view packed, const std::string& compression, std::uint64_t expected);
};

bool McapReader::Parts::isWanted(McapOp kind, std::uint64_t length) const {
  switch (kind) {
    case McapOp::kHeader:
    case McapOp::kSchema:
    case McapOp::kChannel:
    case McapOp::kMessage:
    case McapOp::kChunk:
      if (length <= kMostBytes) return true;
      fail("a record of " + std::to_string(length) + " bytes",
           std::to_string(kMostBytes) + " at most");
    case McapOp::kAttachment:
      return length <= kMostAttachment && attachments.size() < kMostAttachments;
    default:
      return false;
  }
}

bool McapReader::Parts::readRecord(McapOp& kind) {
  while (true) {
    place = at;
    std::string head(kRecordHead, '\0');
    isUnfinished = true;
    if (!read(head)) return false;
    std::string_view bytes = head;
    std::uint8_t number = 0;
    std::uint64_t length = 0;
    take(bytes, number);
    take(bytes, length);
    if (number == 0) fail("a record of kind 0", "1 to 15, or one of 128 and above");
    if (length > size - std::min(at, size)) return false;
    isUnfinished = false;
    kind = static_cast<McapOp>(number);
    if (kind == McapOp::kDataEnd || kind == McapOp::kFooter) return false;
    if (!isWanted(kind, length)) {
      pass(length);
      continue;
    }
    record.resize(length);
    if (read(record)) return true;
    isUnfinished = true;
    return false;
  }
}

void McapReader::Parts::takeHeader() {
  std::string_view bytes = record;
  if (!takeText(bytes, profile)) fail("a header that is too short", "profile and library");
}

void McapReader::Parts::takeSchema(std::string_view content) {
  std::uint16_t id = 0;
  McapSchema schema;
  if (!take(content, id) || !takeText(content, schema.name) ||
      !takeText(content, schema.encoding) || !takeText(content, schema.text))
    fail("a schema that is too short", "number, name, encoding and text");
  schemas.insert_or_assign(id, std::move(schema));
}

void McapReader::Parts::takeChannel(std::string_view content) {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;
  McapChannel channel;
  std::string_view metadata;
  if (!take(content, id) || !take(content, schema) || !takeText(content, channel.topic) ||
      !takeText(content, channel.encoding) || !takeBytes<std::uint32_t>(content, metadata))
    fail("a channel that is too short", "numbers, topic, encoding and metadata");
  while (!metadata.empty()) {
    std::string key;
    std::string value;
    if (!takeText(metadata, key) || !takeText(metadata, value))
      fail("a channel whose metadata is truncated", "keys and values");
    channel.metadata.insert_or_assign(std::move(key), std::move(value));
  }
  channel.id = id;
  if (const auto known = schemas.find(schema); known != schemas.end())
    channel.schema = known->second;
  else if (schema != 0)
    fail("channel " + channel.topic + " of schema " + std::to_string(schema),
         "a schema that came before");
  const auto known = channels.find(id);
  if (known == channels.end()) {
    channels.emplace(id, std::move(channel));
  } else if (known->second.topic != channel.topic ||
             known->second.schema.name != channel.schema.name ||
             known->second.encoding != channel.encoding) {
    fail("channel " + std::to_string(id) + " for " + channel.topic,
         "it to stay " + known->second.topic);
  }
}

void McapReader::Parts::takeAttachment(std::string_view content) {
  const std::string_view whole = content;
  std::uint64_t time = 0;
  std::string called;
  std::string mediaType;
  std::string_view bytes;
  std::uint32_t crc = 0;
  if (!take(content, time) || !take(content, time) || !takeText(content, called) ||
      !takeText(content, mediaType) || !takeBytes<std::uint64_t>(content, bytes))
    fail("an attachment that is too short", "times, name, type and bytes");
  const std::string_view covered = whole.substr(0, whole.size() - content.size());
  if (!take(content, crc)) fail("an attachment without a checksum", "one");
  if (crc != 0 && crc != crcOf(covered)) fail("a damaged attachment", "one that fits its checksum");
  attachments.insert_or_assign(std::move(called), std::string(bytes));
}

void McapReader::Parts::unpack(std::string_view packed, const std::string& compression,
                               std::uint64_t expected) {
  std::string why;
  const auto most = static_cast<std::size_t>(expected);
  if (compression.empty())
    chunk = packed;
  else if (compression == "zstd")
    why = unpackZstd(packed, most + 1, chunk);
  else if (compression == "lz4")
    why = unpackLz4(packed, most + 1, chunk);
  else
    fail("a chunk compressed with '" + compression.substr(0, 16) + "'", "zstd, lz4 or nothing");
  if (!why.empty()) fail("a chunk that " + why, "a sound one");
  if (chunk.size() != expected)
    fail("a chunk of " + std::to_string(chunk.size()) + " bytes",
         "the " + std::to_string(expected) + " that it announces");
}

void McapReader::Parts::takeChunk(std::string_view content) {
  std::uint64_t time = 0;
  std::uint64_t unpacked = 0;
  std::uint32_t crc = 0;
  std::string compression;
  std::string_view packed;
  if (!take(content, time) || !take(content, time) || !take(content, unpacked) ||
      !take(content, crc) || !takeText(content, compression) ||
      !takeBytes<std::uint64_t>(content, packed))
    fail("a chunk that is too short", "times, sizes, compression and records");
  if (unpacked > kMostBytes)
    fail("a chunk of " + std::to_string(unpacked) + " bytes",
         std::to_string(kMostBytes) + " at most");
  unpack(packed, compression, unpacked);
  if (crc != 0 && crc != crcOf(chunk)) fail("a damaged chunk", "one that fits its checksum");
  rest = chunk;
}

bool McapReader::Parts::takeMessage(std::string_view content, McapMessage& message) const {
  std::uint16_t id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t published = 0;
  if (!take(content, id) || !take(content, sequence) || !take(content, message.logTime) ||
      !take(content, published))
    fail("a message that is too short", "channel, number and times");
  const auto channel = channels.find(id);
  if (channel == channels.end())
    fail("a message of channel " + std::to_string(id), "a channel that came before");
  message.channel = &channel->second;
  message.data = content;
  return true;
}

bool McapReader::Parts::look(const Record& one, McapMessage& message) {
  switch (one.kind) {
    case McapOp::kHeader:
      takeHeader();
      return false;
    case McapOp::kSchema:
      takeSchema(one.content);
      return false;
    case McapOp::kChannel:
      takeChannel(one.content);
      return false;
    case McapOp::kChunk:
      takeChunk(one.content);
      return false;
    case McapOp::kAttachment:
      takeAttachment(one.content);
      return false;
    case McapOp::kMessage:
      return takeMessage(one.content, message);
    default:
      return false;
  }
}

McapReader::McapReader(std::istream& file, std::string name)
    : parts_(std::make_unique<Parts>(file, std::move(name))) {}
McapReader::~McapReader() = default;

bool McapReader::next(McapMessage& message) {
  Parts& p = *parts_;
  while (!p.isOver) {
    Record one;
    if (!p.rest.empty()) {
      if (!takeRecord(p.rest, one)) p.fail("a record that does not end within its chunk", "none");
      if (one.kind != McapOp::kSchema && one.kind != McapOp::kChannel &&
          one.kind != McapOp::kMessage)
        continue;
    } else if (p.readRecord(one.kind)) {
      one.content = p.record;
    } else {
      p.isOver = true;
      break;
    }
    if (p.look(one, message)) return true;
  }
  return false;
}

const std::string& McapReader::profile() const { return parts_->profile; }
const std::map<std::string, std::string>& McapReader::attachments() const {
  return parts_->attachments;
}
bool McapReader::isUnfinished() const { return parts_->isUnfinished; }
std::uint64_t McapReader::position() const { return parts_->at; }

}  // namespace ortung::ros2
