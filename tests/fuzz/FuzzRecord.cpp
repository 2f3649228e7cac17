// A record file, whole, each of its lines, and readings in binary form; what was read is written
// and read again.
#include <sys/mman.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ortung/core/BinaryReading.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/records/RecordSource.hpp"

namespace {

using namespace ortung;

auto blanks(std::string_view text) { return std::count(text.begin(), text.end(), ' '); }

void readLines(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view read = text.substr(0, end);
    std::string why;
    if (const auto message = parseLine(read, &why)) {
      std::string line;
      writeLine(*message, line);
      if (parseLine(line) != message) std::abort();
      // Only zeros before a number can be more than what would be written.
      if (line.size() > read.size() || blanks(line) != blanks(read)) std::abort();
    } else if (why.empty()) {
      std::abort();
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void readBinary(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::string_view before = bytes;
    std::string why;
    const auto message = parseBinary(bytes, &why);
    if (!message) {
      if (why.empty() || bytes.data() != before.data()) std::abort();
      return;
    }
    std::string again;
    writeBinary(*message, again);
    std::string_view rest = again;
    if (parseBinary(rest) != message || !rest.empty()) std::abort();
  }
}

void append(std::string& out, std::uint64_t number, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(number >> 8 * i & 0xFF);
}

std::string frame(std::string_view bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), 0);
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  return out;
}

std::string skippable(unsigned variant, const std::string& bytes) {
  std::string out;
  append(out, 0x184D2A50U + variant, 4);
  append(out, bytes.size(), 4);
  return out + bytes;
}

/// A compressed record whose checksums are right, so that what is behind them is reached: the
/// input's first bytes change the head, the next are lines, those behind a 0 a reading; an index
/// of the input's, too.
std::string chunked(std::string_view bytes) {
  constexpr std::size_t kHead = 48;
  if (bytes.size() < 2 * kHead) return "";
  const std::string_view changes = bytes.substr(0, kHead);
  const std::string_view places = bytes.substr(kHead, kHead);
  const std::string_view rest = bytes.substr(2 * kHead);
  const std::string_view lines = rest.substr(0, rest.find('\0'));
  const std::string packed = frame(lines);
  const std::string apart = skippable(14, frame(rest.substr(lines.size())));
  std::string head;
  append(head, 0, 8);
  append(head, 1000, 8);
  append(head, static_cast<std::uint64_t>(std::count(lines.begin(), lines.end(), '\n')), 4);
  append(head, lines.find("# binary ") == lines.npos ? 0 : 1, 4);
  append(head, lines.size(), 8);
  append(head, packed.size(), 8);
  append(head, apart.size(), 8);
  for (std::size_t i = 0; i < kHead; ++i) head[i] = static_cast<char>(head[i] ^ changes[i]);
  std::string record = skippable(13, "ortung record 2\n");
  for (int i = 0; i < 2; ++i) record += skippable(13, "CHNK" + frame(head)) + packed + apart;
  std::string end;
  append(end, record.size(), 8);
  return record + skippable(13, "INDX" + frame(places) + end + "ORTINDEX");
}

void readFile(std::string_view text, const RecordPart& part = {}) {
  static const int file = ::memfd_create("record", MFD_CLOEXEC);
  if (::ftruncate(file, 0) != 0 ||
      ::pwrite(file, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    std::abort();
  try {
    RecordSource source("/proc/self/fd/" + std::to_string(file), part);
    FrameReader reader(source);
    std::vector<Message> frame;
    Timestamp last = INT64_MIN;
    while (reader.next(frame)) {
      if (frame.empty() || frame.front().stamp < last) std::abort();
      last = frame.front().stamp;
    }
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  readLines(text);
  readBinary(text);
  readFile(text);
  const std::string record = chunked(text);
  readFile(record);
  readFile(record, {0.0005, 0.0009});
  return 0;
}
