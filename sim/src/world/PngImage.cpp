#include "PngImage.hpp"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "GridMap.hpp"

namespace ortung {
namespace {

/// The greatest number of bytes to which one deflated byte expands.
constexpr std::size_t kMostPacked = 1032;

/// The data that the decoder's callbacks see.
struct Input {
  const char* at;
  std::size_t left;
  char why[160];  ///< reason why it can't be decoded
};

void take(png_structp png, png_bytep out, std::size_t n) {
  auto& input = *static_cast<Input*>(png_get_io_ptr(png));
  if (n > input.left) png_error(png, "the file ends early");
  std::memcpy(out, input.at, n);
  input.at += n;
  input.left -= n;
}

[[noreturn]] void fail(png_structp png, png_const_charp why) {
  auto& input = *static_cast<Input*>(png_get_error_ptr(png));
  std::snprintf(input.why, sizeof input.why, "%s", why);
  png_longjmp(png, 1);
}

void passOver(png_structp, png_const_charp) {}

/// Holds the library's two structures. The library reports errors by longjmp, past destructors, so
/// functions that call it have no objects with destructors.
class Decoder {
 public:
  explicit Decoder(const std::string& bytes)
      : input_{bytes.data(), bytes.size(), "there is no memory"},
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &input_, fail, passOver)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {}
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  const char* why() const { return input_.why; }
  int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
  int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
  std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
  bool hasAlpha() const { return png_get_channels(png_, info_) == 2; }

  /// Reads everything before the pixels.
  bool readHeader() {
    if (info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, &input_, take);
    png_set_user_limits(png_, kMaxGridCells, kMaxGridCells);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_benign_errors(png_, 0);  // e.g. more pixels than there is room for are errors
    png_read_info(png_, info_);
    return true;
  }

  /// Makes the library convert pixels to grey of 8 bits, with or without alpha.
  bool makeGrey() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_expand(png_);
    png_set_strip_16(png_);
    if ((png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) != 0)
      png_set_rgb_to_gray_fixed(png_, PNG_ERROR_ACTION_NONE, 29900, 58700);  // ITU-R BT.601
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool readRows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  Input input_;
  png_structp png_;
  png_infop info_;
};

}  // namespace

MapImage decodePng(const std::filesystem::path& file, const std::string& bytes) {
  Decoder decoder(bytes);
  const auto refuse = [&] {
    throw MapError(file.string() + ": the image cannot be decoded: " + decoder.why());
  };
  if (!decoder.readHeader()) refuse();
  const int width = decoder.width();
  const int height = decoder.height();
  checkGrid(file, width, height, 1e-3, 0.0, 0.0);
  if (decoder.rowBytes() * static_cast<std::size_t>(height) > kMostPacked * bytes.size())
    throw MapError(file.string() + ": its " + std::to_string(bytes.size()) +
                   " bytes cannot hold the " + std::to_string(width) + " x " +
                   std::to_string(height) + " pixels of its header");
  if (!decoder.makeGrey()) refuse();

  std::vector<std::uint8_t> pixels(decoder.rowBytes() * static_cast<std::size_t>(height));
  std::vector<png_bytep> rows(static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = pixels.data() + i * decoder.rowBytes();
  if (!decoder.readRows(rows.data())) refuse();

  MapImage image{width, height, {}, {}};
  if (!decoder.hasAlpha()) {
    image.grey = std::move(pixels);
    return image;
  }
  image.grey.resize(pixels.size() / 2);
  image.opaque.resize(pixels.size() / 2);
  for (std::size_t i = 0; i < image.grey.size(); ++i) {
    image.grey[i] = pixels[2 * i];
    image.opaque[i] = pixels[2 * i + 1] >= 128 ? 1 : 0;
  }
  return image;
}

}  // namespace ortung
