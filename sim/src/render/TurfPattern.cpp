#include "TurfPattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "FaceView.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr int kTexels = 512;  ///< texels to a side of a tile, a power of two
constexpr std::int32_t kMask = kTexels - 1;
constexpr std::size_t kGroup = 16;     ///< pixels that are painted together
constexpr float kBladeTexel = 0.006F;  ///< texel of the tile that is seen close to the camera [m]
constexpr float kSpotTexel = 0.1F;     ///< texel of the tile that is seen from afar [m]
constexpr float kFine = 0.012F;        ///< size of the finest grain [m]
constexpr float kMiddle = 0.12F;       ///< size of the coarser grain [m]
constexpr float kLevel = 1e-3F;        ///< directions less steep than this show no pattern

/// Noise on a square that repeats: random numbers in [-0.5, 0.5] on a lattice, smoothly
/// interpolated.
class Noise {
 public:
  Noise(float texel, float size, std::uint64_t stream)
      : cells_(static_cast<int>(std::lround(kTexels * texel / size))),
        numbers_(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_)) {
    Random random(kSeed, stream);
    for (double& number : numbers_) number = random.uniform(-0.5, 0.5);
  }
  double at(int column, int row) const {
    const double x = cells_ * (column + 0.5) / kTexels, y = cells_ * (row + 0.5) / kTexels;
    const int left = static_cast<int>(x), above = static_cast<int>(y);
    const double u = smooth(x - left), v = smooth(y - above);
    return std::lerp(std::lerp(number(left, above), number(left + 1, above), u),
                     std::lerp(number(left, above + 1), number(left + 1, above + 1), u), v);
  }

 private:
  static constexpr std::uint64_t kSeed = 17;
  static double smooth(double t) { return t * t * (3.0 - 2.0 * t); }
  double number(int column, int row) const {
    return numbers_[static_cast<std::size_t>(row % cells_) * static_cast<std::size_t>(cells_) +
                    static_cast<std::size_t>(column % cells_)];
  }
  int cells_;
  std::vector<double> numbers_;
};

using Tile = std::vector<std::uint32_t>;  ///< two numbers of 16 bits each: 32768 + 65535 * noise

template <class Low, class High>
Tile tileOf(const Low& low, const High& high) {
  const auto word = [](double noise) {
    return static_cast<std::uint32_t>(
        std::lround(32767.5 + 65535.0 * std::clamp(noise, -0.5, 0.5)));
  };
  Tile tile;
  for (int row = 0; row < kTexels; ++row)
    for (int column = 0; column < kTexels; ++column)
      tile.push_back(word(low(column, row)) | word(high(column, row)) << 16);
  return tile;
}

/// The tiles of all floors; a seed says where on them a floor begins.
struct Tiles {
  Tile blades;  ///< low: fine grain, high: coarser grain
  Tile spots;   ///< low: patches
};

const Tiles& tiles() {
  static const Tiles kTiles = [] {
    const Noise fine(kBladeTexel, kFine, 0), middle(kBladeTexel, kMiddle, 1);
    const Noise small(kSpotTexel, 0.9F, 2), large(kSpotTexel, 3.0F, 3);
    const auto of = [](const Noise& noise) {
      return [&noise](int column, int row) { return noise.at(column, row); };
    };
    const auto patches = [&](int column, int row) {
      return (large.at(column, row) + 0.5 * small.at(column, row)) / 1.5;
    };
    return Tiles{tileOf(of(fine), of(middle)), tileOf(patches, patches)};
  }();
  return kTiles;
}

/// What is the same for a whole face.
struct Paint {
  const std::uint32_t* blades;
  const std::uint32_t* spots;
  float height;                    ///< height of the camera [m]
  float x, y;                      ///< the camera relative to the scene's middle [m]
  float shiftX, shiftY;            ///< added to a place to find it on the tiles [m]
  float xLow, xHigh, yLow, yHigh;  ///< bounds of the field relative to the middle [m]
  float pixel;                     ///< size of a pixel at a distance of 1
  float grain, patches, stripes, acrossX, acrossY;
  std::array<float, 3> field, ground;  ///< their colours, of 255
};

/// The pixels of a row: the direction of the first, and from each to the next.
struct Row {
  std::array<float, 3> first, step;
  std::uint32_t* pixels;
  std::size_t groups;
};

/// Returns a whole number below a value that is above -2^20.
ORTUNG_INLINE std::int32_t below(float value) {
  return static_cast<std::int32_t>(value + 1048576.0F) - 1048576;
}

/// Returns the index of a texel, signed, as gathering instructions have it.
ORTUNG_INLINE std::int32_t texelAt(float x, float y, float perTexel) {
  return (below(y * perTexel) & kMask) * kTexels + (below(x * perTexel) & kMask);
}

// Each choice is between two values that are known, so that the compiler makes no branches.
ORTUNG_INLINE float lesser(float a, float b) { return a < b ? a : b; }
ORTUNG_INLINE float greater(float a, float b) { return a > b ? a : b; }
ORTUNG_INLINE float unit(float value) { return lesser(greater(value, 0.0F), 1.0F); }

ORTUNG_INLINE float noiseOf(std::uint32_t sixteenBits) {
  return static_cast<float>(static_cast<std::int32_t>(sixteenBits)) * (1.0F / 65535.0F) - 0.5F;
}

ORTUNG_INLINE std::uint32_t channel(std::uint32_t pixel, int shift, float more) {
  const float value =
      static_cast<float>(static_cast<std::int32_t>(pixel >> shift & 0xFFU)) + more + 0.5F;
  const float bounded = lesser(greater(value, 0.0F), 255.0F);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(bounded)) << shift;
}

/// Paints one pixel. What is finer than a pixel fades.
ORTUNG_INLINE std::uint32_t paintPixel(const Paint& paint, float dx, float dy, float dz,
                                       std::uint32_t pixel) {
  const float down = greater(-dz, kLevel);
  const float perHeight = 1.0F / down;
  const float far = paint.height * perHeight;
  const float x = paint.x + far * dx;
  const float y = paint.y + far * dy;
  const float stretched = paint.pixel * far * perHeight;
  // How long a pixel is there, squared.
  const float squared = stretched * stretched * (dx * dx + dy * dy + dz * dz);
  const float onX = x + paint.shiftX;
  const float onY = y + paint.shiftY;
  const std::uint32_t blade = paint.blades[texelAt(onX, onY, 1.0F / kBladeTexel)];
  const std::uint32_t spot = paint.spots[texelAt(onX, onY, 1.0F / kSpotTexel)];
  const float across = x * paint.acrossX + y * paint.acrossY;
  const float phase = across - static_cast<float>(below(across));
  const float stripe = std::abs(phase - 0.5F) > 0.25F ? 1.0F : -1.0F;
  const float near = unit(1.5F - squared * (1.0F / (0.02F * 0.02F))) * noiseOf(blade & 0xFFFFU) +
                     unit(1.5F - squared * (1.0F / (0.15F * 0.15F))) * noiseOf(blade >> 16);
  const float all =
      paint.grain * near + 1.5F * paint.patches * noiseOf(spot & 0xFFFFU) + paint.stripes * stripe;
  const float floor = static_cast<float>(static_cast<std::int32_t>(255U - (pixel >> 24)));
  const float isDown = dz < -kLevel ? 1.0F : 0.0F;
  const float share = isDown * floor * (1.0F / 255.0F) * greater(all, -0.95F);
  const float acrossX = lesser(x - paint.xLow, paint.xHigh - x);
  const float acrossY = lesser(y - paint.yLow, paint.yHigh - y);
  const float inside = lesser(acrossX, acrossY);
  const float isField = inside >= 0.0F ? 1.0F : 0.0F;
  const float field = isField * share;
  const float ground = share - field;
  return channel(pixel, 0, field * paint.field[0] + ground * paint.ground[0]) |
         channel(pixel, 8, field * paint.field[1] + ground * paint.ground[1]) |
         channel(pixel, 16, field * paint.field[2] + ground * paint.ground[2]) | 0xFF000000U;
}

ORTUNG_INLINE void paintRow(const Paint& all, const Row& row) {
  const Paint paint = all;
  for (std::size_t g = 0; g < row.groups; ++g) {
    std::array<std::uint32_t, kGroup> pixels;
    std::memcpy(pixels.data(), row.pixels + g * kGroup, sizeof pixels);
    std::uint32_t common = 0xFF000000U;
    for (std::size_t i = 0; i < kGroup; ++i) common &= pixels[i];
    if (common == 0xFF000000U) continue;  // no floor at all
    const auto first = static_cast<float>(static_cast<std::int32_t>(g * kGroup));
    for (std::size_t i = 0; i < kGroup; ++i) {
      const float at = first + static_cast<float>(static_cast<std::int32_t>(i));
      pixels[i] =
          paintPixel(paint, row.first[0] + at * row.step[0], row.first[1] + at * row.step[1],
                     row.first[2] + at * row.step[2], pixels[i]);
    }
    std::memcpy(row.pixels + g * kGroup, pixels.data(), sizeof pixels);
  }
}

void paintPortable(const Paint& paint, const Row& row) { paintRow(paint, row); }
#ifdef ORTUNG_X86
ORTUNG_AVX2 void paintAvx2(const Paint& paint, const Row& row) { paintRow(paint, row); }
ORTUNG_AVX512 void paintAvx512(const Paint& paint, const Row& row) { paintRow(paint, row); }
#else
constexpr auto paintAvx2 = paintPortable, paintAvx512 = paintPortable;
#endif

void paintBest(const Paint& paint, const Row& row) {
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return paintAvx512(paint, row);
    case InstructionSet::kAvx2:
      return paintAvx2(paint, row);
    case InstructionSet::kPortable:
    case InstructionSet::kNeon:
      break;
  }
  paintPortable(paint, row);
}

/// Paints a row of any length.
void paintWhole(const Paint& paint, Row row, std::size_t width) {
  row.groups = width / kGroup;
  paintBest(paint, row);
  const std::size_t done = row.groups * kGroup;
  if (done == width) return;
  std::array<std::uint32_t, kGroup> rest{};
  std::copy_n(row.pixels + done, width - done, rest.begin());
  Row last = row;
  for (std::size_t axis = 0; axis < 3; ++axis)
    last.first[axis] += static_cast<float>(done) * row.step[axis];
  last.pixels = rest.data();
  last.groups = 1;
  paintBest(paint, last);
  std::copy_n(rest.begin(), width - done, row.pixels + done);
}

std::array<float, 3> bytesOf(const Rgb& colour, const Lighting& light) {
  std::array<float, 3> bytes;
  for (std::size_t i = 0; i < 3; ++i) bytes[i] = 255.0F * colour[i] * light.colour[i];
  return bytes;
}

}  // namespace

TurfPattern::TurfPattern(const StandingScene& scene, const Lighting& light)
    : scene_(scene), light_(light) {
  Random random(light.seed, 0);
  const double most = kTexels * static_cast<double>(kSpotTexel);
  shiftX_ = static_cast<float>(random.uniform(0.0, most));
  shiftY_ = static_cast<float>(random.uniform(0.0, most));
}

bool TurfPattern::isIn(const Lighting& light) {
  return light.grain != 0.0F || light.patches != 0.0F || light.stripes != 0.0F;
}

void TurfPattern::add(const Drawing& drawing, std::span<std::uint32_t> colours) const {
  if (!(drawing.camera.position[2] > 0.0)) return;
  for (const SheetFace& face : drawing.faces) add(drawing, face, colours);
}

void TurfPattern::add(const Drawing& drawing, const SheetFace& face,
                      std::span<std::uint32_t> colours) const {
  const std::array<double, 3>& camera = drawing.camera.position;
  const double stepX = (face.right - face.left) / face.width;
  const double stepY = (face.bottom - face.top) / face.height;
  const auto single = [](double value) { return static_cast<float>(value); };
  const Box2& field = scene_.field;
  const Paint paint{.blades = tiles().blades.data(),
                    .spots = tiles().spots.data(),
                    .height = single(camera[2]),
                    .x = single(camera[0] - scene_.middle.x),
                    .y = single(camera[1] - scene_.middle.y),
                    .shiftX = shiftX_,
                    .shiftY = shiftY_,
                    .xLow = single(field.xLow),
                    .xHigh = single(field.xHigh),
                    .yLow = single(field.yLow),
                    .yHigh = single(field.yHigh),
                    .pixel = single(std::max(stepX, stepY)),
                    .grain = light_.grain,
                    .patches = light_.patches,
                    .stripes = light_.stripes,
                    .acrossX = -0.5F * std::sin(light_.stripeAngle) / light_.stripeWidth,
                    .acrossY = 0.5F * std::cos(light_.stripeAngle) / light_.stripeWidth,
                    .field = bytesOf(scene_.isPitch ? light_.turf : light_.ground, light_),
                    .ground = bytesOf(light_.ground, light_)};
  const FaceView view(drawing.camera, face);
  const std::array<double, 3> right = view.direction(1.0, 0.0, 0.0);
  for (int v = 0; v < face.height; ++v) {
    const std::array<double, 3> first =
        view.direction(face.left + 0.5 * stepX, face.top + (v + 0.5) * stepY, 1.0);
    Row row{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row.first[axis] = single(first[axis]);
      row.step[axis] = single(stepX * right[axis]);
    }
    row.pixels = colours.data() +
                 static_cast<std::size_t>(face.row + v) * static_cast<std::size_t>(drawing.width) +
                 face.column;
    paintWhole(paint, row, static_cast<std::size_t>(face.width));
  }
}

}  // namespace ortung
