#include "Ros1File.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "../src/Compression.hpp"
#include "Bzip2.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr std::uint32_t kMostHeader = 1U << 20;  // bytes
constexpr std::size_t kMostName = 4096;          // bytes of a topic or a type
constexpr std::size_t kMostConnections = 65536;

enum Operation : std::uint8_t { kMessage = 2, kBagHeader, kIndex, kChunk, kChunkInfo, kConnection };

bool takeSize(std::string_view& bytes, std::uint32_t& size) {
  if (bytes.size() < sizeof size) return false;
  std::memcpy(&size, bytes.data(), sizeof size);
  bytes.remove_prefix(sizeof size);
  return true;
}

bool takeBlock(std::string_view& bytes, std::string_view& block) {
  std::uint32_t size = 0;
  if (!takeSize(bytes, size) || size > bytes.size()) return false;
  block = bytes.substr(0, size);
  bytes.remove_prefix(size);
  return true;
}

/// Finds a field of a header, whose fields are NAME=VALUE after their size each.
std::optional<std::string_view> valueOf(std::string_view header, std::string_view name) {
  for (std::string_view field; takeBlock(header, field);)
    if (field.size() > name.size() && field.starts_with(name) && field[name.size()] == '=')
      return field.substr(name.size() + 1);
  return std::nullopt;
}

template <class T>
T numberOf(std::string_view bytes) {
  T number = 0;
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

}  // namespace

Ros1File::Ros1File(std::unique_ptr<std::istream> file, std::string name)
    : file_(std::move(file)), name_(std::move(name)) {
  file_->seekg(0, std::ios::end);
  const std::streamoff end = file_->tellg();
  file_->seekg(0);
  size_ = end > 0 ? static_cast<std::uint64_t>(end) : 0;
  std::string beginning;
  if (!read(beginning, kVersion.size()) || beginning != kVersion)
    fail("a bag of ROS 1 of another version", "version 2.0; `rosbag fix` makes it of older ones");
}

void Ros1File::fail(const std::string& found, const std::string& expected) const {
  throw std::runtime_error(name_ + ": found " + found + " at byte " + std::to_string(place_) +
                           ", expected " + expected);
}

/// Reads bytes; false if there are fewer in the file.
bool Ros1File::read(std::string& bytes, std::uint64_t size) {
  if (size > size_ - std::min(at_, size_)) return false;
  bytes.resize(static_cast<std::size_t>(size));
  file_->read(bytes.data(), static_cast<std::streamsize>(size));
  if (file_->bad()) fail("bytes that can't be read", "the file's");
  at_ += static_cast<std::uint64_t>(file_->gcount());
  return static_cast<std::uint64_t>(file_->gcount()) == size;
}

bool Ros1File::readSize(std::uint32_t& size) {
  std::string bytes;
  if (!read(bytes, sizeof size)) return false;
  size = numberOf<std::uint32_t>(bytes);
  return true;
}

bool Ros1File::readRecord(Record& record) {
  while (true) {
    place_ = at_;
    if (at_ == size_) return false;
    isCut_ = true;
    std::uint32_t size = 0;
    if (!readSize(size) || size > size_ - std::min(at_, size_)) return false;
    if (size > kMostHeader)
      fail("a header of " + std::to_string(size) + " bytes",
           std::to_string(kMostHeader) + " at most");
    if (!read(header_, size) || !readSize(size) || size > size_ - std::min(at_, size_))
      return false;
    const auto operation = static_cast<std::uint8_t>(need(header_, "op", 1)[0]);
    if (operation == kIndex || operation == kChunkInfo) {
      file_->seekg(static_cast<std::streamoff>(size), std::ios::cur);
      at_ += size;
    } else {
      if (size > kMostBytes)
        fail("a record of " + std::to_string(size) + " bytes",
             std::to_string(kMostBytes) + " at most");
      if (!read(data_, size)) return false;
    }
    isCut_ = false;
    record = {header_, data_};
    if (operation != kIndex && operation != kChunkInfo) return true;
  }
}

/// Takes the next record within a chunk.
bool Ros1File::takeRecord(Record& record) {
  return takeBlock(rest_, record.header) && takeBlock(rest_, record.data);
}

/// Returns the value of a field. @param size its size [bytes], or 0 for any
std::string_view Ros1File::need(std::string_view header, std::string_view field,
                                std::size_t size) const {
  const auto value = valueOf(header, field);
  if (!value || (size != 0 && value->size() != size))
    fail("a record without a sound field '" + std::string(field) + "'",
         size == 0 ? "one" : "one of " + std::to_string(size) + " bytes");
  return *value;
}

void Ros1File::takeBagHeader(std::string_view header) {
  if (const auto encryptor = valueOf(header, "encryptor"); encryptor && !encryptor->empty())
    fail("a bag that is encrypted", "one that is not");
  const auto index = numberOf<std::uint64_t>(need(header, "index_pos", 8));
  isWithoutIndex_ = index == 0 || index > size_;  // 0 until the recorder ends
}

void Ros1File::takeConnection(const Record& record) {
  const auto id = numberOf<std::uint32_t>(need(record.header, "conn", 4));
  const std::string_view topic = need(record.header, "topic", 0);
  const std::string_view type = need(record.data, "type", 0);
  if (topic.size() > kMostName || type.size() > kMostName)
    fail("a topic or type with a name of " + std::to_string(std::max(topic.size(), type.size())) +
             " bytes",
         std::to_string(kMostName) + " at most");
  McapChannel channel;
  channel.topic = topic.starts_with('/') ? topic : "/" + std::string(topic);
  channel.encoding = "ros1";
  channel.schema.name = type;
  const auto known = channels_.find(id);
  if (known == channels_.end()) {
    if (channels_.size() >= kMostConnections)
      fail("one more connection", std::to_string(kMostConnections) + " at most");
    channels_.emplace(id, std::move(channel));
  } else if (known->second.topic != channel.topic ||
             known->second.schema.name != channel.schema.name) {
    fail("connection " + std::to_string(id) + " for " + channel.topic.substr(0, 80),
         "it to stay " + known->second.topic.substr(0, 80));
  }
}

void Ros1File::takeChunk(const Record& record) {
  const std::string_view compression = need(record.header, "compression", 0);
  const std::uint64_t expected = numberOf<std::uint32_t>(need(record.header, "size", 4));
  if (expected > kMostBytes)
    fail("a chunk of " + std::to_string(expected) + " bytes",
         std::to_string(kMostBytes) + " at most");
  if (!unpacked_.add(record.data.size(), expected))
    fail("chunks that unpack to much more than the file has", "those of a recording");
  const auto most = static_cast<std::size_t>(expected) + 1;
  std::string why;
  if (compression == "none")
    chunk_ = record.data;
  else if (compression == "bz2")
    why = unpackBzip2(record.data, most, chunk_);
  else if (compression == "lz4")
    why = unpackLz4(record.data, most, chunk_);
  else
    fail("a chunk compressed with '" + std::string(compression.substr(0, 16)) + "'",
         "bz2, lz4 or none");
  if (!why.empty()) fail("a chunk that " + why, "a sound one");
  if (chunk_.size() != expected)
    fail("a chunk of " + std::to_string(chunk_.size()) + " bytes",
         "the " + std::to_string(expected) + " that it announces");
  rest_ = chunk_;
}

void Ros1File::takeMessage(const Record& record, McapMessage& message) const {
  const auto id = numberOf<std::uint32_t>(need(record.header, "conn", 4));
  const std::string_view time = need(record.header, "time", 8);
  const auto channel = channels_.find(id);
  if (channel == channels_.end())
    fail("a message of connection " + std::to_string(id), "a connection that came before");
  message.channel = &channel->second;
  message.logTime = numberOf<std::uint32_t>(time) * std::uint64_t{1'000'000'000} +
                    numberOf<std::uint32_t>(time.substr(4));
  message.data = record.data;
}

bool Ros1File::look(const Record& record, bool isInChunk, McapMessage& message) {
  switch (static_cast<std::uint8_t>(need(record.header, "op", 1)[0])) {
    case kMessage:
      takeMessage(record, message);
      return true;
    case kConnection:
      takeConnection(record);
      return false;
    case kBagHeader:
      if (!isInChunk) takeBagHeader(record.header);
      return false;
    case kChunk:
      if (isInChunk) fail("a chunk within a chunk", "none");
      takeChunk(record);
      return false;
    default:  // records of later versions
      return false;
  }
}

bool Ros1File::next(McapMessage& message) {
  while (!isOver_) {
    Record record;
    const bool isInChunk = !rest_.empty();
    if (isInChunk) {
      if (!takeRecord(record)) fail("a record that does not end within its chunk", "none");
    } else if (!readRecord(record)) {
      isOver_ = true;
      return false;
    }
    if (look(record, isInChunk, message)) return true;
  }
  return false;
}

}  // namespace ortung::ros2
