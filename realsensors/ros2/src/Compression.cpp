#include "Compression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>

namespace ortung::ros2 {
namespace {

constexpr int kLevel = 3;
constexpr std::size_t kFirst = 1U << 16;  // bytes that are reserved at first

/// Enlarges the output; false if it has its greatest size.
bool grow(std::string& out, std::size_t used, std::size_t most) {
  if (used >= most) return false;
  out.resize(std::min(most, std::max(kFirst, 2 * used)));
  return true;
}

}  // namespace

std::string packZstd(std::string_view bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0)
    throw std::runtime_error(std::string("can't be compressed: ") + ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

std::string packLz4(std::string_view bytes) {
  std::string out(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  const std::size_t size =
      LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr);
  if (LZ4F_isError(size) != 0)
    throw std::runtime_error(std::string("can't be compressed: ") + LZ4F_getErrorName(size));
  out.resize(size);
  return out;
}

std::string unpackZstd(std::string_view packed, std::size_t most, std::string& out) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                     ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::size_t used = 0;
  std::size_t left = 1;  // 0 at the end of a frame
  while (left != 0 || in.pos < in.size) {
    if (used == out.size() && !grow(out, used, most)) return "holds more than it says";
    ZSTD_outBuffer to{out.data(), out.size(), used};
    left = ZSTD_decompressStream(context.get(), &to, &in);
    if (ZSTD_isError(left) != 0) return std::string("is damaged: ") + ZSTD_getErrorName(left);
    if (to.pos == used && in.pos == in.size && left != 0 && used < out.size())
      return "is damaged: it is cut off";
    used = to.pos;
  }
  out.resize(used);
  return "";
}

std::string unpackLz4(std::string_view packed, std::size_t most, std::string& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0)
    throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, LZ4F_freeDecompressionContext);
  std::size_t used = 0;
  std::size_t left = 1;  // 0 at the end of a frame
  while (left != 0 || !packed.empty()) {
    if (used == out.size() && !grow(out, used, most)) return "holds more than it says";
    std::size_t to = out.size() - used;
    std::size_t from = packed.size();
    left = LZ4F_decompress(context.get(), out.data() + used, &to, packed.data(), &from, nullptr);
    if (LZ4F_isError(left) != 0) return std::string("is damaged: ") + LZ4F_getErrorName(left);
    if (to == 0 && from == 0 && left != 0) return "is damaged: it is cut off";
    used += to;
    packed.remove_prefix(from);
  }
  out.resize(used);
  return "";
}

}  // namespace ortung::ros2
