// A record file, whole, each of its lines, and readings in binary form; what was read is written
// and read again.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ortung/core/BinaryReading.hpp"
#include "ortung/core/Record.hpp"

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

void readFile(std::string_view text) {
  static const int file = ::memfd_create("record", MFD_CLOEXEC);
  if (::ftruncate(file, 0) != 0 ||
      ::pwrite(file, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    std::abort();
  try {
    RecordSource source("/proc/self/fd/" + std::to_string(file));
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
  return 0;
}
