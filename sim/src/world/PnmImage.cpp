#include "PnmImage.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include "GridMap.hpp"

namespace ortung {
namespace {

constexpr long kMostWhite = 65535;

/// Numbers between blanks and comments.
class PnmText {
 public:
  PnmText(const std::string& bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  std::size_t at() const { return at_; }
  bool atEnd() {
    skipBlanks();
    return at_ >= bytes_.size();
  }
  /// Returns the next number, a huge one as 10^8 or more; nothing if there is none.
  std::optional<long> next() {
    skipBlanks();
    const std::size_t start = at_;
    long value = 0;
    for (; at_ < bytes_.size() && std::isdigit(static_cast<unsigned char>(bytes_[at_])); ++at_)
      if (value < 100000000) value = value * 10 + (bytes_[at_] - '0');
    return at_ == start ? std::nullopt : std::optional(value);
  }

 private:
  void skipBlanks() {
    for (; at_ < bytes_.size(); ++at_) {
      if (bytes_[at_] == '#')
        while (at_ < bytes_.size() && bytes_[at_] != '\n' && bytes_[at_] != '\r') ++at_;
      else if (!std::isspace(static_cast<unsigned char>(bytes_[at_])))
        return;
    }
  }

  const std::string& bytes_;
  std::size_t at_;
};

class PnmImage {
 public:
  PnmImage(const std::filesystem::path& file, const std::string& bytes)
      : file_(file),
        bytes_(bytes),
        isPlain_(bytes[1] < '4'),
        isColour_(bytes[1] == '3' || bytes[1] == '6') {}

  MapImage decode(const PixelMeaning& meaning) {
    PnmText text(bytes_, 2);
    const auto width = text.next();
    const auto height = text.next();
    const auto white = text.next();
    if (!width || !height || !white) refuse("has no complete PNM header");
    checkGrid(file_, static_cast<double>(*width), static_cast<double>(*height), 1e-3, 0.0, 0.0);
    if (*white < 1 || *white > kMostWhite)
      refuse("white is " + std::to_string(*white) + ", expected 1 to 65535");
    white_ = static_cast<std::uint32_t>(*white);
    const std::size_t n = static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
    values_ = n * (isColour_ ? 3 : 1);
    MapImage image{static_cast<int>(*width), static_cast<int>(*height), {}};
    isPlain_ ? readPlain(text, image, n, meaning) : readBinary(text.at() + 1, image, n, meaning);
    return image;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw MapError(file_.string() + ": " + what);
  }

  /// A channel from 0 to MapPixel::kFull.
  std::uint32_t scaled(std::uint32_t value) const {
    return (std::min(value, white_) * MapPixel::kFull + white_ / 2) / white_;
  }

  template <class Next>
  void fill(MapImage& image, std::size_t n, const PixelMeaning& meaning, const Next& next) const {
    image.meanings.resize(n);
    for (std::uint8_t& one : image.meanings) {
      MapPixel pixel;
      if (isColour_)
        for (int i = 0; i < 3; ++i) pixel.colours += scaled(next());
      else
        pixel.colours = 3 * scaled(next());
      one = meaning(pixel);
    }
  }

  void readBinary(std::size_t from, MapImage& image, std::size_t n, const PixelMeaning& meaning) {
    const std::size_t depth = white_ > 255 ? 2 : 1;
    const std::size_t found = bytes_.size() - std::min(bytes_.size(), from);
    if (found < values_ * depth)
      refuse("ends after " + std::to_string(found) + " bytes of pixels, expected " +
             std::to_string(values_ * depth));
    const auto* byte = reinterpret_cast<const unsigned char*>(bytes_.data()) + from;
    fill(image, n, meaning, [&]() -> std::uint32_t {
      const std::uint32_t first = *byte++;
      return depth == 1 ? first : first * 256 + *byte++;
    });
  }

  void readPlain(PnmText& text, MapImage& image, std::size_t n, const PixelMeaning& meaning) {
    const std::size_t found = bytes_.size() - text.at();
    if (found < 2 * values_)  // a blank and a digit each
      refuse("ends after " + std::to_string(found) + " characters of pixels, expected " +
             std::to_string(values_) + " numbers");
    std::size_t taken = 0;
    fill(image, n, meaning, [&]() -> std::uint32_t {
      const auto value = text.next();
      if (!value)
        refuse((text.atEnd() ? "ends after " : "has something else behind ") +
               std::to_string(taken) + " numbers, expected " + std::to_string(values_));
      ++taken;
      return static_cast<std::uint32_t>(*value);
    });
  }

  const std::filesystem::path& file_;
  const std::string& bytes_;
  bool isPlain_;
  bool isColour_;
  std::uint32_t white_ = 0;  ///< value of white, the greatest one
  std::size_t values_ = 0;   ///< number of values of all pixels
};

}  // namespace

MapImage decodePnm(const std::filesystem::path& file, const std::string& bytes,
                   const PixelMeaning& meaning) {
  return PnmImage(file, bytes).decode(meaning);
}

}  // namespace ortung
