#include <fmt/format.h>

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <span>

#include "Picture.hpp"
#include "Report.hpp"

namespace ortung::app {
namespace {

constexpr Colour kSolid{58, 66, 80};
constexpr Colour kNotStandable{226, 231, 238};
constexpr Colour kStandable{255, 255, 255};
constexpr int kMaxPixels = 4096;  ///< of the map's longer side
// A path is not drawn over steps that are longer and faster than this: nobody drove them.
constexpr double kJump = 1.0;       ///< [m]
constexpr double kJumpSpeed = 3.0;  ///< [m/s]
constexpr std::size_t kMaxPoints = 20000;

std::string base64(std::span<const std::byte> bytes) {
  using namespace boost::archive::iterators;
  using Encoder = base64_from_binary<transform_width<const char*, 6, 8>>;
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  std::string padded(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  padded.append(missing, '\0');  // the encoder reads whole groups of three
  std::string text(Encoder(padded.data()), Encoder(padded.data() + padded.size()));
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

/// The region as a picture, a pixel a cell; every n-th cell of maps too large for a page.
std::string maskPng(const FieldRegion& region) {
  const FieldGrid& grid = region.grid;
  const int every = std::max(grid.columns, grid.rows) / kMaxPixels + 1;
  const int width = (grid.columns + every - 1) / every;
  const int height = (grid.rows + every - 1) / every;
  Picture picture(width, height, kSolid);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto cell =
          static_cast<std::size_t>(y * every) * static_cast<std::size_t>(grid.columns) +
          static_cast<std::size_t>(x * every);
      if (region.open[cell] == 0) continue;
      picture.set(x, height - 1 - y, region.standable[cell] != 0 ? kStandable : kNotStandable);
    }
  }
  return base64(picture.png());
}

/// Collects the commands of an SVG path.
class Path {
 public:
  void add(Timestamp stamp, const Pose2& pose) {
    if (!isFinite(pose)) return;
    const double way = distance(last_, pose);
    const double seconds = toSeconds(stamp) - toSeconds(lastStamp_);
    const bool jumps = empty_ || (way > kJump && way > kJumpSpeed * seconds);
    // "h0" makes a lonely point visible: its round cap is drawn.
    text_ +=
        fmt::format(fmt::runtime(jumps ? "M{:.3f} {:.3f}h0" : "L{:.3f} {:.3f}"), pose.x, pose.y);
    last_ = pose;
    lastStamp_ = stamp;
    empty_ = false;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  Pose2 last_;
  Timestamp lastStamp_ = 0;
  bool empty_ = true;
};

/// A round length for the scale bar, about a fifth of the map's width [m].
double barLength(double width) {
  const double wanted = width / 5.0;
  const double ten = std::pow(10.0, std::floor(std::log10(wanted)));
  if (wanted >= 5.0 * ten) return 5.0 * ten;
  return wanted >= 2.0 * ten ? 2.0 * ten : ten;
}

std::string mark(const Pose2& pose, double radius, const char* kind) {
  return fmt::format(R"(<circle class="{}" cx="{:.3f}" cy="{:.3f}" r="{:.3f}"/>)", kind, pose.x,
                     pose.y, radius);
}

std::string scaleBar(double x, double y, double length, double size) {
  return fmt::format(R"(<g class="bar"><path d="M{0:.3f} {1:.3f}v{4:.3f}h{2:.3f}v-{4:.3f}"/>)"
                     R"(<text x="{3:.3f}" y="{1:.3f}" font-size="{5:.3f}">{2:g} m</text></g>)",
                     x, y, length, x + 0.5 * length, 0.4 * size, size);
}

}  // namespace

std::string mapSvg(const RunResult& run) {
  const FieldGrid& grid = run.tableInfo.region.grid;
  const double width = grid.columns * grid.cell;
  const double height = grid.rows * grid.cell;
  const double size = 0.018 * std::max(width, height);  // of letters and marks [m]
  const auto& points = run.figures.points;

  Path truth;
  Path estimate;
  const std::size_t everyPoint = points.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < points.size(); i += everyPoint) {
    truth.add(points[i].stamp, points[i].truth);
  }
  const std::size_t everyEstimate = run.estimates.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < run.estimates.size(); i += everyEstimate) {
    estimate.add(run.estimates[i].stamp, run.estimates[i].pose);
  }

  std::string svg = fmt::format(
      R"(<svg id="map" viewBox="{:.3f} {:.3f} {:.3f} {:.3f}" role="img" aria-label="Map with paths">)",
      grid.originX, -(grid.originY + height), width, height + 2.4 * size);
  svg += fmt::format(
      R"(<image x="{:.3f}" y="{:.3f}" width="{:.3f}" height="{:.3f}" preserveAspectRatio="none" href="data:image/png;base64,{}"/>)",
      grid.originX, -(grid.originY + height), width, height, maskPng(run.tableInfo.region));
  svg += R"x(<g transform="scale(1,-1)">)x";
  svg += fmt::format(R"(<path class="estimate" d="{}"/>)", estimate.text());
  if (!points.empty()) {
    svg += fmt::format(R"(<path class="truth" d="{}"/>)", truth.text());
    svg += mark(points.front().truth, 0.5 * size, "start");
    svg += mark(points.back().truth, 0.5 * size, "end");
  }
  svg += fmt::format(
      R"(<circle id="truth-now" class="now truth" r="{0:.3f}" visibility="hidden"/>)"
      R"(<circle id="estimate-now" class="now estimate" r="{0:.3f}" visibility="hidden"/></g>)",
      0.6 * size);
  svg += scaleBar(grid.originX + 0.5 * size, -grid.originY + 1.4 * size, barLength(width), size);
  return svg + "</svg>";
}

}  // namespace ortung::app
