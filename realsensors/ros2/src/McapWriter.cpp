#include "ortung/ros2/McapWriter.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "Compression.hpp"
#include "McapBytes.hpp"

namespace ortung::ros2 {
namespace {

/// Times and places of the messages of each channel in a chunk.
using Index = std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>>;

struct Span {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last = 0;
  void hold(std::uint64_t time) {
    first = std::min(first, time);
    last = std::max(last, time);
  }
  void put(std::string& out) const {
    ros2::put(out, last < first ? std::uint64_t{0} : first);
    ros2::put(out, last);
  }
};

std::string_view nameOf(McapCompression compression) {
  switch (compression) {
    case McapCompression::kLz4:
      return "lz4";
    case McapCompression::kZstd:
      return "zstd";
    case McapCompression::kNone:
      break;
  }
  return "";
}

std::string pack(std::string_view bytes, McapCompression compression) {
  switch (compression) {
    case McapCompression::kLz4:
      return packLz4(bytes);
    case McapCompression::kZstd:
      return packZstd(bytes);
    case McapCompression::kNone:
      break;
  }
  return std::string(bytes);
}

/// Appends a list after its length in bytes.
template <class List, class Put>
void putList(std::string& out, const List& list, Put putOne) {
  std::string pieces;
  for (const auto& one : list) putOne(pieces, one);
  putText(out, pieces);
}

}  // namespace

struct McapWriter::Parts {
  Sink sink;
  Options options;
  std::uint64_t offset = 0;  ///< number of bytes written
  Crc crc;                   ///< checksum of the data section, then of the summary
  std::vector<std::string> schemas, channels;  ///< records by number - 1, and by number
  std::map<std::uint16_t, std::uint64_t> counts;
  std::map<std::uint16_t, std::uint32_t> sequences;
  std::string chunk;
  Index index;
  Span chunkSpan, span;
  std::vector<std::string> chunkIndexes, attachmentIndexes;
  std::uint64_t messages = 0;
  bool isFinished = false;

  void out(std::string_view bytes) {
    crc.add(bytes);
    offset += bytes.size();
    sink(bytes);
  }
  void outRecord(McapOp kind, std::string_view content) {
    std::string record;
    putRecord(record, kind, content);
    out(record);
  }
  /// Writes a message, schema or channel to the chunk, or to the file if there are no chunks.
  void addRecord(McapOp kind, std::string_view content) {
    options.isChunked ? putRecord(chunk, kind, content) : outRecord(kind, content);
  }
  void endChunk();
  void putMessageIndexes(std::string& chunkIndex);
  void writeGroup(McapOp kind, const std::vector<std::string>& records, std::string& offsets);
  std::string statistics() const;
};

McapWriter::McapWriter(Sink sink, Options options) : parts_(std::make_unique<Parts>()) {
  parts_->sink = std::move(sink);
  parts_->options = std::move(options);
  parts_->out(kMcapMagic);
  std::string header;
  putText(header, parts_->options.profile);
  putText(header, "ortung");
  parts_->outRecord(McapOp::kHeader, header);
}

McapWriter::~McapWriter() = default;

std::uint64_t McapWriter::messages() const { return parts_->messages; }

std::uint16_t McapWriter::addSchema(std::string_view name, std::string_view encoding,
                                    std::string_view text) {
  if (parts_->schemas.size() + 1 > std::numeric_limits<std::uint16_t>::max())
    throw std::invalid_argument("an MCAP file holds 65535 schemas at most");
  const auto id = static_cast<std::uint16_t>(parts_->schemas.size() + 1);  // 0 means: none
  std::string record;
  put(record, id);
  for (const std::string_view piece : {name, encoding, text}) putText(record, piece);
  parts_->addRecord(McapOp::kSchema, record);
  parts_->schemas.push_back(std::move(record));
  return id;
}

std::uint16_t McapWriter::addChannel(std::uint16_t schema, std::string_view topic,
                                     std::string_view encoding,
                                     const std::map<std::string, std::string>& metadata) {
  if (parts_->channels.size() >= std::numeric_limits<std::uint16_t>::max())
    throw std::invalid_argument("an MCAP file holds 65535 channels at most");
  const auto id = static_cast<std::uint16_t>(parts_->channels.size());
  std::string record;
  put(record, id);
  put(record, schema);
  putText(record, topic);
  putText(record, encoding);
  putList(record, metadata, [](std::string& out, const auto& entry) {
    putText(out, entry.first);
    putText(out, entry.second);
  });
  parts_->addRecord(McapOp::kChannel, record);
  parts_->channels.push_back(std::move(record));
  return id;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t time, std::string_view message) {
  Parts& p = *parts_;
  if (p.options.isChunked) p.index[channel].emplace_back(time, p.chunk.size());
  std::string record;
  put(record, channel);
  put(record, p.sequences[channel]++);
  put(record, time);  // time of recording
  put(record, time);  // time of publishing
  record += message;
  p.addRecord(McapOp::kMessage, record);
  p.chunkSpan.hold(time);
  p.span.hold(time);
  ++p.counts[channel];
  ++p.messages;
  if (p.chunk.size() >= p.options.chunkBytes) p.endChunk();
}

void McapWriter::Parts::endChunk() {
  if (chunk.empty()) return;
  const std::string packed = pack(chunk, options.compression);
  std::string content;
  chunkSpan.put(content);
  put(content, static_cast<std::uint64_t>(chunk.size()));
  put(content, crcOf(chunk));
  putText(content, nameOf(options.compression));
  put(content, static_cast<std::uint64_t>(packed.size()));
  content += packed;
  const std::uint64_t begin = offset;
  outRecord(McapOp::kChunk, content);

  std::string entry;
  chunkSpan.put(entry);
  put(entry, begin);
  put(entry, offset - begin);
  putMessageIndexes(entry);
  putText(entry, nameOf(options.compression));
  put(entry, static_cast<std::uint64_t>(packed.size()));
  put(entry, static_cast<std::uint64_t>(chunk.size()));
  chunkIndexes.push_back(std::move(entry));
  chunk.clear();
  index.clear();
  chunkSpan = {};
}

/// Writes the places of the chunk's messages, and adds the places of these indexes to @p
/// chunkIndex.
void McapWriter::Parts::putMessageIndexes(std::string& chunkIndex) {
  const std::uint64_t begin = offset;
  std::map<std::uint16_t, std::uint64_t> places;
  for (const auto& [channel, list] : index) {
    places[channel] = offset;
    std::string content;
    put(content, channel);
    putList(content, list, [](std::string& out, const auto& one) {
      put(out, one.first);
      put(out, one.second);
    });
    outRecord(McapOp::kMessageIndex, content);
  }
  putList(chunkIndex, places, [](std::string& out, const auto& one) {
    put(out, one.first);
    put(out, one.second);
  });
  put(chunkIndex, offset - begin);
}

void McapWriter::attach(std::string_view name, std::string_view mediaType, std::string_view bytes) {
  Parts& p = *parts_;
  p.endChunk();  // attachments are between chunks
  constexpr std::uint64_t kNoTime = 0;
  std::string content;
  put(content, kNoTime);  // time of recording
  put(content, kNoTime);  // time of creation
  putText(content, name);
  putText(content, mediaType);
  put(content, static_cast<std::uint64_t>(bytes.size()));
  content += bytes;
  put(content, crcOf(content));
  const std::uint64_t begin = p.offset;
  p.outRecord(McapOp::kAttachment, content);
  std::string entry;
  for (const std::uint64_t number : {begin, p.offset - begin, kNoTime, kNoTime}) put(entry, number);
  put(entry, static_cast<std::uint64_t>(bytes.size()));
  putText(entry, name);
  putText(entry, mediaType);
  p.attachmentIndexes.push_back(std::move(entry));
}

std::string McapWriter::Parts::statistics() const {
  std::string content;
  put(content, messages);
  put(content, static_cast<std::uint16_t>(schemas.size()));
  put(content, static_cast<std::uint32_t>(channels.size()));
  put(content, static_cast<std::uint32_t>(attachmentIndexes.size()));
  put(content, std::uint32_t{0});  // number of metadata records
  put(content, static_cast<std::uint32_t>(chunkIndexes.size()));
  span.put(content);
  putList(content, counts, [](std::string& out, const auto& one) {
    put(out, one.first);
    put(out, one.second);
  });
  return content;
}

/// Writes a group of the summary, and appends its place to @p offsets.
void McapWriter::Parts::writeGroup(McapOp kind, const std::vector<std::string>& records,
                                   std::string& offsets) {
  if (records.empty()) return;
  const std::uint64_t begin = offset;
  for (const std::string& record : records) outRecord(kind, record);
  std::string content;
  put(content, static_cast<std::uint8_t>(kind));
  put(content, begin);
  put(content, offset - begin);
  putRecord(offsets, McapOp::kSummaryOffset, content);
}

void McapWriter::finish() {
  Parts& p = *parts_;
  if (p.isFinished) return;
  p.isFinished = true;
  p.endChunk();
  std::string end;
  put(end, p.crc.value());
  p.outRecord(McapOp::kDataEnd, end);

  p.crc = {};
  const std::uint64_t summary = p.offset;
  std::string offsets;
  p.writeGroup(McapOp::kSchema, p.schemas, offsets);
  p.writeGroup(McapOp::kChannel, p.channels, offsets);
  p.writeGroup(McapOp::kStatistics, {p.statistics()}, offsets);
  p.writeGroup(McapOp::kChunkIndex, p.chunkIndexes, offsets);
  p.writeGroup(McapOp::kAttachmentIndex, p.attachmentIndexes, offsets);
  const std::uint64_t summaryOffsets = p.offset;
  p.out(offsets);

  // The checksum covers the footer up to the checksum itself.
  std::string footer;
  put(footer, static_cast<std::uint8_t>(McapOp::kFooter));
  put(footer, std::uint64_t{2 * sizeof summary + sizeof(std::uint32_t)});
  put(footer, summary);
  put(footer, summaryOffsets);
  p.out(footer);
  std::string crc;
  put(crc, p.crc.value());
  p.out(crc);
  p.out(kMcapMagic);
}

}  // namespace ortung::ros2
