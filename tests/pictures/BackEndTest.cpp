#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <thread>

#include "Paths.hpp"
#include "Snapshots.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::test {
namespace {

/// Sets $ORTUNG_GL for as long as it lives.
class BackEnd {
 public:
  explicit BackEnd(const char* name) { ::setenv("ORTUNG_GL", name, 1); }
  ~BackEnd() { ::unsetenv("ORTUNG_GL"); }
  BackEnd(const BackEnd&) = delete;
  BackEnd& operator=(const BackEnd&) = delete;
};

std::unique_ptr<SimWorld> msl() {
  auto world = readWorld(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml");
  for (const Primitive& one : world->movables())
    world->addBody({one.kind, one.name, one.colour, {inOwnFrame(one)}}, {3.0, 0.5, 0.0});
  return world;
}

CameraView mirror() {
  return viewOf(
      "model = \"unified\"\nsize_px = [480, 480]\nxi = 0.95\nfocal_px = [185, 185]\n"
      "inner_px = 50\nouter_px = 236\n",
      0.75, radians(90.0));
}

Snapshot drawnBy(const char* backEnd, const CameraView& view) {
  const BackEnd set(backEnd);
  const auto world = msl();  // painters are the world's own
  CameraPicture camera(view, {.strength = 0.5, .seed = 3});
  return snap(camera, *world, {6.0, 1.0, 0.3});
}

TEST(BackEnds, GiveTheSamePicture) {
  for (const CameraView& view : {mirror(), viewOf(kPerspective, 0.7, radians(15.0))}) {
    Snapshot one = drawnBy("osmesa", view);
    Snapshot other = drawnBy("egl", view);
    ASSERT_EQ(one.words.size(), other.words.size());
    const auto a = ImageData::pixelsOf(one.words);
    const auto b = ImageData::pixelsOf(other.words);
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); i += 3)
      different += a[i] != b[i] || a[i + 1] != b[i + 1] || a[i + 2] != b[i + 2] ? 1U : 0U;
    EXPECT_LE(static_cast<double>(different), 1e-4 * static_cast<double>(a.size() / 3));
  }
}

TEST(BackEnds, ThatNobodyKnowsAreRefused) {
  const BackEnd set("glide");
  const auto world = msl();
  CameraPicture camera(mirror());
  try {
    snap(camera, *world, {});
    FAIL() << "drew a picture";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "ORTUNG_GL is \"glide\", expected osmesa or egl");
  }
}

TEST(Pictures, AreTheSameInManyThreadsAtATime) {
  const auto world = msl();
  const auto draw = [&](int i) {
    CameraPicture camera(mirror(), {.strength = 1.0, .seed = 5});
    return snap(camera, *world, {0.4 * i, 0.1 * i, 0.3 * i}, 0,
                CameraPicture::Noise{1, static_cast<std::uint64_t>(i)});
  };
  constexpr int kPictures = 8;
  std::vector<Snapshot> alone, together(kPictures);
  for (int i = 0; i < kPictures; ++i) alone.push_back(draw(i));
  std::vector<std::thread> threads;
  for (int i = 0; i < kPictures; ++i)
    threads.emplace_back([&, i] { together[static_cast<std::size_t>(i)] = draw(i); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < kPictures; ++i) EXPECT_EQ(together[i].words, alone[i].words) << i;
}

TEST(Pictures, OfAWorldThatIsReadAgainAreTheSame) {
  CameraPicture camera(mirror());
  const Snapshot one = snap(camera, *msl(), {1.0, 2.0, 0.5});
  EXPECT_EQ(snap(camera, *msl(), {1.0, 2.0, 0.5}).words, one.words);
  EXPECT_EQ(snap(camera, *msl()->another(), {1.0, 2.0, 0.5}).size, one.size);
}

}  // namespace
}  // namespace ortung::test
