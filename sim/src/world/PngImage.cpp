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
/// The most memory for all pixels of an image whose rows are interlaced [bytes].
constexpr std::size_t kMostInterlaced = std::size_t{1} << 27;

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
  std::size_t channels() const { return png_get_channels(png_, info_); }
  /// Number of bytes of a channel.
  std::size_t depth() const { return png_get_bit_depth(png_, info_) / 8u; }
  bool isInterlaced() const { return png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE; }

  /// Reads everything before the pixels.
  bool readHeader() {
    if (info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, &input_, take);
    png_set_user_limits(png_, kMaxGridCells, kMaxGridCells);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    // A damaged chunk of what is transparent would be passed over, like a comment.
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_benign_errors(png_, 0);  // e.g. more pixels than there is room for are errors
    png_read_info(png_, info_);
    return true;
  }

  /// Makes the library convert pixels to grey or colours of 8 or 16 bits, with or without alpha.
  bool expand() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_expand(png_);
    if (isInterlaced()) png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool readRow(png_bytep row) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, row, nullptr);
    return true;
  }

  bool readRows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    return true;
  }

  bool readEnd() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  Input input_;
  png_structp png_;
  png_infop info_;
};

/// How the channels of a pixel lie in a row.
class PixelLayout {
 public:
  explicit PixelLayout(const Decoder& decoder)
      : channels_(decoder.channels()), depth_(decoder.depth()) {}

  MapPixel at(const png_byte* row, std::size_t column) const {
    const png_byte* pixel = row + column * channels_ * depth_;
    const std::uint32_t first = channel(pixel, 0);
    MapPixel found{3 * first, MapPixel::kFull};
    if (channels_ >= 3) found.colours = first + channel(pixel, 1) + channel(pixel, 2);
    if (channels_ % 2 == 0) found.alpha = channel(pixel, channels_ - 1);
    return found;
  }

 private:
  std::uint32_t channel(const png_byte* pixel, std::size_t i) const {
    if (depth_ == 1) return pixel[i] * 257u;
    return pixel[2 * i] * 256u + pixel[2 * i + 1];
  }

  std::size_t channels_;  ///< 1: grey, 2: grey and alpha, 3: colours, 4: colours and alpha
  std::size_t depth_;     ///< bytes of a channel
};

/// Reads all pixels. @returns whether it was possible
bool readPixels(const std::filesystem::path& file, Decoder& decoder, const PixelMeaning& meaning,
                MapImage& image) {
  const PixelLayout layout(decoder);
  const auto height = static_cast<std::size_t>(image.height);
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t atOnce = decoder.isInterlaced() ? height : 1;
  const std::size_t size = decoder.rowBytes() * atOnce;
  if (atOnce > 1 && size > kMostInterlaced)
    throw MapError(file.string() + ": has interlaced pixels of " + std::to_string(size) +
                   " bytes, expected 2^27 at most; save it without interlacing");
  std::vector<png_byte> pixels(size);
  std::vector<png_bytep> rows(atOnce);
  for (std::size_t i = 0; i < atOnce; ++i) rows[i] = pixels.data() + i * decoder.rowBytes();
  if (decoder.isInterlaced() && !decoder.readRows(rows.data())) return false;
  image.meanings.resize(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    if (!decoder.isInterlaced() && !decoder.readRow(rows[0])) return false;
    const png_byte* const read = rows[decoder.isInterlaced() ? row : 0];
    for (std::size_t column = 0; column < width; ++column)
      image.meanings[row * width + column] = meaning(layout.at(read, column));
  }
  return decoder.readEnd();
}

}  // namespace

MapImage decodePng(const std::filesystem::path& file, const std::string& bytes,
                   const PixelMeaning& meaning) {
  Decoder decoder(bytes);
  const auto refuse = [&] {
    throw MapError(file.string() + ": the image cannot be decoded: " + decoder.why());
  };
  if (!decoder.readHeader()) refuse();
  MapImage image{decoder.width(), decoder.height(), {}};
  checkGrid(file, image.width, image.height, 1e-3, 0.0, 0.0);
  if (decoder.rowBytes() * static_cast<std::size_t>(image.height) > kMostPacked * bytes.size())
    throw MapError(file.string() + ": its " + std::to_string(bytes.size()) +
                   " bytes cannot hold the " + std::to_string(image.width) + " x " +
                   std::to_string(image.height) + " pixels of its header");
  if (!decoder.expand() || !readPixels(file, decoder, meaning, image)) refuse();
  return image;
}

}  // namespace ortung
