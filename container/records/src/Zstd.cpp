#include "Zstd.hpp"

#include <zstd.h>

#include <new>
#include <stdexcept>

#include "Bytes.hpp"

namespace ortung::zstd {

struct Packer::Context {
  ZSTD_CCtx* it = ZSTD_createCCtx();
};

Packer::Packer(int level) : context_(std::make_unique<Context>()) {
  if (context_->it == nullptr) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context_->it, ZSTD_c_compressionLevel, level);
  ZSTD_CCtx_setParameter(context_->it, ZSTD_c_checksumFlag, 1);
}

Packer::~Packer() { ZSTD_freeCCtx(context_->it); }

std::size_t Packer::pack(std::string_view bytes, std::string& out) {
  const std::size_t begin = out.size();
  out.resize(begin + ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress2(context_->it, out.data() + begin, out.size() - begin,
                                          bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0)
    throw std::runtime_error(std::string("can't be compressed: ") + ZSTD_getErrorName(size));
  out.resize(begin + size);
  return size;
}

struct Unpacker::Context {
  ZSTD_DCtx* it = ZSTD_createDCtx();
};

Unpacker::Unpacker() : context_(std::make_unique<Context>()) {
  if (context_->it == nullptr) throw std::bad_alloc();
}

Unpacker::~Unpacker() { ZSTD_freeDCtx(context_->it); }

std::string Unpacker::unpack(std::string_view frame, std::span<char> out) {
  const std::size_t found =
      ZSTD_decompressDCtx(context_->it, out.data(), out.size(), frame.data(), frame.size());
  if (ZSTD_isError(found) != 0) return std::string("is damaged: ") + ZSTD_getErrorName(found);
  return found == out.size() ? "" : "is damaged: it is shorter than it announces";
}

std::uint64_t contentSize(std::string_view frame) {
  const auto size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  return size == ZSTD_CONTENTSIZE_ERROR ? ZSTD_CONTENTSIZE_UNKNOWN : size;
}

std::string mayHold(std::string_view frame, std::size_t size) {
  const std::uint64_t announced = contentSize(frame);
  if (announced == ZSTD_CONTENTSIZE_UNKNOWN)
    return "is no frame of zstd that says how much it holds";
  if (announced != size)
    return "holds " + std::to_string(announced) + " bytes, expected " + std::to_string(size);
  // Four bytes make a block, which holds 128 KiB at most: a frame that announces more is refused.
  constexpr std::size_t kMostOfAByte = (128U << 10) / 4;
  if (size / kMostOfAByte > frame.size())
    return "can't hold the " + std::to_string(size) + " bytes that it announces";
  return "";
}

std::string skippableHead(int variant, std::size_t size) {
  std::string head;
  putNumber(head, static_cast<std::uint32_t>(ZSTD_MAGIC_SKIPPABLE_START + variant));
  putNumber(head, static_cast<std::uint32_t>(size));
  return head;
}

}  // namespace ortung::zstd
