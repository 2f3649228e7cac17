/// What is found in a picture: lines along rows and columns, beside asking OpenCV for edges and
/// straight lines in it.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/vision/BallFinder.hpp"
#include "ortung/vision/LineFinder.hpp"

namespace {

using namespace ortung;

/// A floor with five lines across it.
Picture floorWithLines(int width, int height) {
  Picture picture{{width, height}, {}};
  Random random(1);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      bool isLine = false;
      for (int k = 0; k < 5; ++k)
        isLine = isLine || std::abs(v - 60.0 - 80.0 * k - 0.2 * u) < 3.0 + k;
      const int noise = static_cast<int>(random.uniform(-6.0, 6.0));
      for (const int channel : {isLine ? 230 : 40, isLine ? 235 : 140, isLine ? 228 : 60})
        picture.pixels.push_back(static_cast<std::uint8_t>(channel + noise));
    }
  return picture;
}

void lines(benchmark::State& state) {
  const Picture picture = floorWithLines(640, 480);
  const ImageView view = picture.view();
  const ColourTable colours(findColours({&view, 1}));
  LineFinder finder(
      {.spacing = static_cast<int>(state.range(0)), .findsFaint = state.range(1) != 0});
  std::size_t points = 0;
  for (auto _ : state) points = finder.find(view, colours).size();
  state.counters["points"] = static_cast<double>(points);
}
BENCHMARK(lines)->Args({6, 0})->Args({6, 1})->Args({1, 0})->Args({1, 1})->Unit(
    benchmark::kMillisecond);

void edgesAndStraightLinesOfOpenCv(benchmark::State& state) {
  const Picture picture = floorWithLines(640, 480);
  const cv::Mat rgb(480, 640, CV_8UC3, const_cast<std::uint8_t*>(picture.pixels.data()));
  for (auto _ : state) {
    cv::Mat grey, edges;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    cv::Canny(grey, edges, 60, 120);
    std::vector<cv::Vec4i> found;
    cv::HoughLinesP(edges, found, 1.0, CV_PI / 180.0, 40, 20, 5);
    benchmark::DoNotOptimize(found.data());
  }
}
BENCHMARK(edgesAndStraightLinesOfOpenCv)->Unit(benchmark::kMillisecond);

void floorColour(benchmark::State& state) {
  const Picture picture = floorWithLines(640, 480);
  const ImageView view = picture.view();
  for (auto _ : state) {
    const ColourTable colours(findColours({&view, 1}));
    benchmark::DoNotOptimize(&colours);
  }
}
BENCHMARK(floorColour)->Unit(benchmark::kMillisecond);

void balls(benchmark::State& state) {
  const Picture picture = floorWithLines(640, 480);
  const ImageView view = picture.view();
  const ColourTable colours(findColours({&view, 1}));
  Parameters camera("camera");
  camera.set("size_px", std::vector<double>{640, 480});
  camera.set("focal_px", std::vector<double>{400, 400});
  BallFinder finder({readCamera(camera), {.z = 0.8, .tilt = 0.35}}, {});
  for (auto _ : state) benchmark::DoNotOptimize(finder.find(view, colours));
}
BENCHMARK(balls)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
