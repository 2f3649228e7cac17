#include "Bzip2.hpp"

#include <bzlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>

namespace ortung::ros2 {
namespace {

constexpr std::size_t kFirst = 1U << 16;  // bytes that are reserved at first

unsigned int bounded(std::size_t size) {
  return static_cast<unsigned int>(
      std::min<std::size_t>(size, std::numeric_limits<unsigned int>::max()));
}

}  // namespace

std::string unpackBzip2(std::string_view packed, std::size_t most, std::string& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream,
                                                                       BZ2_bzDecompressEnd);
  std::string in(packed);  // the library takes no constant bytes
  stream.next_in = in.data();
  stream.avail_in = bounded(in.size());
  std::size_t used = 0;
  while (true) {
    if (used == out.size()) {
      if (used >= most) return "holds more than it says";
      out.resize(std::min(most, std::max(kFirst, 2 * used)));
    }
    stream.next_out = out.data() + used;
    stream.avail_out = bounded(out.size() - used);
    const int result = BZ2_bzDecompress(&stream);
    const auto now = static_cast<std::size_t>(stream.next_out - out.data());
    if (result == BZ_MEM_ERROR) throw std::bad_alloc();
    if (result != BZ_OK && result != BZ_STREAM_END)
      return "is damaged: bzip2 reports error " + std::to_string(result);
    if (result == BZ_OK && now == used && stream.avail_in == 0) return "is damaged: it is cut off";
    used = now;
    if (result == BZ_STREAM_END) break;
  }
  if (stream.avail_in > 0) return "is damaged: it goes on behind its end";
  out.resize(used);
  return "";
}

}  // namespace ortung::ros2
