#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "Paths.hpp"
#include "Snapshots.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/InstructionSet.hpp"

namespace ortung::test {
namespace {

constexpr const char* kEye =
    "model = \"perspective\"\nsize_px = [321, 240]\nfocal_px = [180, 180]\n";

std::unique_ptr<SimWorld> msl() { return readWorld(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml"); }

Snapshot look(const Variation& variation,
              const std::optional<CameraPicture::Noise>& noise = CameraPicture::Noise{1, 1},
              const char* eye = kEye) {
  CameraPicture camera(viewOf(eye, 0.7, radians(20.0)), variation);
  return snap(camera, *msl(), {7.0, 1.0, 0.2}, 0, noise);
}

double differenceOf(Snapshot& one, Snapshot& other) {
  const auto a = ImageData::pixelsOf(one.words);
  const auto b = ImageData::pixelsOf(other.words);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

TEST(Looks, WithoutVariationAreThoseOfNoSeed) {
  EXPECT_EQ(look({0.0, 1}).words, look({0.0, 2}).words);
  EXPECT_EQ(look({0.0, 1}, std::nullopt).words, look({0.0, 1}).words);
}

TEST(Looks, FollowTheSeedAlone) {
  Snapshot one = look({0.7, 11});
  Snapshot again = look({0.7, 11});
  Snapshot other = look({0.7, 12});
  EXPECT_EQ(one.words, again.words);
  EXPECT_GT(differenceOf(one, other), 5.0);
}

TEST(Looks, AreTheFartherFromPlainOnesTheStrongerTheVariation) {
  Snapshot plain = look({0.0, 0});
  double last = 0.0;
  for (const double strength : {0.1, 0.4, 1.0}) {
    double mean = 0.0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Snapshot varied = look({strength, seed});
      mean += differenceOf(plain, varied) / 6.0;
    }
    EXPECT_GT(mean, 1.5 * last) << strength;
    last = mean;
  }
}

/// Mean and sigma of the noise, by two pictures that differ in nothing else.
TEST(Looks, HaveTheNoiseThatEffectsTell) {
  const Variation variation{1.0, 4};
  const SensorEffects effects = effectsOf(variation);
  Snapshot clean = look(variation, std::nullopt);
  Snapshot noisy = look(variation, CameraPicture::Noise{1, 7});
  const auto a = ImageData::pixelsOf(clean.words);
  const auto b = ImageData::pixelsOf(noisy.words);
  double mean = 0.0, squares = 0.0, expected = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] < 40 || a[i] > 200) continue;  // neither end cuts anything off
    const double sigma = effects.noise + effects.shotNoise * a[i] / 255.0;
    mean += b[i] - a[i];
    squares += (b[i] - a[i]) * (b[i] - a[i]);
    expected += sigma * sigma + 1.0 / 12.0;
    ++count;
  }
  ASSERT_GT(count, 50'000);
  EXPECT_NEAR(mean / count, 0.0, 0.1);
  EXPECT_NEAR(std::sqrt(squares / count), std::sqrt(expected / count), 0.15);
  Snapshot other = look(variation, CameraPicture::Noise{1, 8});
  EXPECT_GT(differenceOf(noisy, other), 0.5);
}

TEST(Looks, AreTheSameBitsWithAllInstructionSets) {
  const char* const mirror =
      "model = \"unified\"\nsize_px = [203, 201]\nxi = 0.95\nfocal_px = [80, 80]\n";
  for (const char* eye : {kEye, mirror}) {
    useInstructionSet(InstructionSet::kPortable);
    const Snapshot portable = look({1.0, 9}, CameraPicture::Noise{1, 1}, eye);
    for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
      if (!hasInstructionSet(set)) continue;
      useInstructionSet(set);
      EXPECT_EQ(look({1.0, 9}, CameraPicture::Noise{1, 1}, eye).words, portable.words);
    }
    useInstructionSet(std::nullopt);
  }
}

/// A drawing of the camera's own faces, which is its picture.
std::vector<std::uint32_t> drawn(const CameraPicture& camera, const World& world,
                                 const Pose2& sensor, const Lighting& light) {
  const ImageSize size = camera.sheet().size();
  std::vector<std::uint32_t> colours(static_cast<std::size_t>(size.width * size.height));
  world.draw({cameraPoseOf(camera.camera(), sensor), camera.sheet().faces(), size.width,
              size.height, 0, light},
             {colours});
  return colours;
}

TEST(Looks, OfAPatternedFloorAreOnTheFloorAlone) {
  const auto world = msl();
  CameraPicture camera(viewOf(kEye, 0.7, radians(20.0)));
  const Pose2 sensor{7.0, 1.0, 0.2};
  const Annotation shown = annotate(camera, *world, sensor);
  Lighting light;
  const std::vector<std::uint32_t> even = drawn(camera, *world, sensor, light);
  light.grain = 0.4F;
  const std::vector<std::uint32_t> patterned = drawn(camera, *world, sensor, light);
  double floor = 0.0, changed = 0.0, sum = 0.0;
  for (int v = 1; v + 1 < shown.size.height; ++v)
    for (int u = 1; u + 1 < shown.size.width; ++u) {
      const std::size_t i = shown.index(u, v);
      if (!shown.isInside(u, v)) continue;  // edges are partly floor
      if (shown.kind(u, v) == PixelClass::kField) {
        const int difference =
            static_cast<int>(patterned[i] >> 8 & 0xFFU) - static_cast<int>(even[i] >> 8 & 0xFFU);
        floor += 1.0;
        changed += difference != 0;
        sum += difference;
      } else if (shown.object(u, v) != 0 || (even[i] & 0xFFFFFFU) == 0xFFFFFFU) {
        EXPECT_EQ(patterned[i] & 0xFFFFFFU, even[i] & 0xFFFFFFU) << u << ", " << v;
      }
    }
  ASSERT_GT(floor, 20'000.0);
  EXPECT_GT(changed, 0.7 * floor);
  EXPECT_NEAR(sum / floor, 0.0, 4.0) << "the floor is as bright as before in the mean";
}

/// A pattern lies on the floor: where the camera goes does not matter.
TEST(Looks, OfAPatternStayInPlaceWhenTheCameraMoves) {
  const auto world = worldOf(
      "[world]\nx_m = [-9, 9]\ny_m = [-9, 9]\n[[landmark]]\nkind = \"none\"\n"
      "identity = 1\nposition_m = [0, 0]\n");
  CameraPicture camera(viewOf(kEye, 1.0, radians(90.0)));
  Lighting light;
  light.patches = 0.4F;
  light.seed = 5;
  const auto before = drawn(camera, *world, {0.0, 0.0, 0.0}, light);
  // Straight down from a height of 1 m, 180 px are a metre: 36 pixels up are 0.2 m ahead.
  const auto after = drawn(camera, *world, {0.2, 0.0, 0.0}, light);
  const ImageSize size = camera.sheet().size();
  const auto width = static_cast<std::size_t>(size.width);
  std::set<std::uint32_t> shades;
  for (std::size_t v = 0; v + 36 < static_cast<std::size_t>(size.height); ++v)
    for (std::size_t u = 0; u < width; ++u) {
      const int one = static_cast<int>(before[v * width + u] & 0xFFU);
      const int other = static_cast<int>(after[(v + 36) * width + u] & 0xFFU);
      shades.insert(before[v * width + u] & 0xFFU);
      ASSERT_NEAR(one, other, 2) << u << ", " << v;
    }
  EXPECT_GT(shades.size(), 3u);
}

TEST(Looks, OfWhatACameraDoesNotSeeAreBlack) {
  CameraPicture camera(
      viewOf("model = \"unified\"\nsize_px = [200, 200]\nxi = 0.95\n"
             "focal_px = [75, 75]\ninner_px = 30\nouter_px = 90\n",
             0.7, radians(90.0)));
  Snapshot picture = snap(camera, *msl(), {});
  for (const auto& [u, v] : {std::pair{100, 100}, {100, 115}, {2, 2}, {197, 100}})
    for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(picture.at(u, v, channel), 0);
  EXPECT_GT(picture.at(100, 40, 1), 50);
}

TEST(Looks, OfACameraThatIsTooLargeAreRefused) {
  try {
    const CameraPicture camera(viewOf(
        "model = \"perspective\"\nsize_px = [5000, 100]\nfocal_px = [800, 800]\n", 0.7, 0.0));
    FAIL() << "took it";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "a camera of 5000 x 100 pixels can't be drawn, expected at most 4096 to a side");
  }
}

}  // namespace
}  // namespace ortung::test
