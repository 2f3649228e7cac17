#include "FieldCanvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "Axis.hpp"
#include "FieldMarks.hpp"
#include "LandmarkLabels.hpp"
#include "Palette.hpp"

namespace ortung::app {
namespace {

constexpr int kLetters = 2;
constexpr int kLetterHeight = 8 * kLetters;
constexpr int kTick = 5;        // length of a tick [px]
constexpr int kTickRoom = 80;   // width for a label [px]
constexpr double kRadius = 15;  // radius of the mark of the truth [px]

int nearest(double pixel) { return static_cast<int>(std::lround(pixel)); }

}  // namespace

FieldCanvas::FieldCanvas(Picture& picture, const FieldGrid& grid, int left, int top, int zoom)
    : picture_(picture), grid_(grid), left_(left), top_(top), zoom_(zoom) {}

void FieldCanvas::axes() const {
  const double right = grid_.originX + grid_.columns * grid_.cell;
  const double upper = grid_.originY + grid_.rows * grid_.cell;
  const int bottom = top_ + height();
  for (const double x : axisTicks(grid_.originX, right, std::max(2, width() / kTickRoom))) {
    const int at = nearest(pixelX(x));
    const std::string label = fmt::format("{:.6g}", x);
    picture_.fill(at, bottom, 1, kTick, palette::kInk);
    picture_.text(at - Picture::textWidth(kLetters, label) / 2, bottom + kTick + 3, kLetters,
                  palette::kInk, label);
  }
  for (const double y : axisTicks(grid_.originY, upper, std::max(2, height() / kTickRoom))) {
    const int at = nearest(pixelY(y));
    const std::string label = fmt::format("{:.6g}", y);
    picture_.fill(left_ - kTick, at, kTick, 1, palette::kInk);
    picture_.text(left_ - kTick - 4 - Picture::textWidth(kLetters, label), at - kLetterHeight / 2,
                  kLetters, palette::kInk, label);
  }
  picture_.text(4, top_ - kLetterHeight - 6, kLetters, palette::kInk, "y [m]");
  const std::string name = "x [m]";
  picture_.text(left_ + width() / 2 - Picture::textWidth(kLetters, name) / 2,
                bottom + kTick + 5 + kLetterHeight + 4, kLetters, palette::kInk, name);
}

void FieldCanvas::line(const FieldLine& line) const {
  const auto points = pointsOf(line);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto& [fromX, fromY] = points[i - 1];
    const auto& [toX, toY] = points[i];
    picture_.line(pixelX(fromX), pixelY(fromY), pixelX(toX), pixelY(toY), 1, palette::kLine);
  }
}

void FieldCanvas::field(const FieldModel& model) const {
  const std::size_t lines = std::min(model.lines.size(), kMostMarks);
  for (std::size_t i = 0; i < lines; ++i) line(model.lines[i]);
  const std::size_t marks = std::min(model.landmarks.size(), kMostMarks);
  const std::vector<LandmarkLabel> labels =
      labelsOf(model, kLetterHeight * grid_.cell / std::max(zoom_, 1),
               grid_.originX + grid_.columns * grid_.cell);
  for (std::size_t i = 0; i < marks; ++i) {
    const Landmark& mark = model.landmarks[i];
    if (grid_.cellAt(mark.x, mark.y) < 0) continue;
    drawLandmark(picture_, pixelX(mark.x), pixelY(mark.y), 6);
    if (i >= labels.size()) continue;
    const std::string& text = labels[i].text;
    const int x = nearest(pixelX(mark.x));
    picture_.text(labels[i].isLeft ? x - 9 - Picture::textWidth(kLetters, text) : x + 10,
                  nearest(pixelY(mark.y)) - 7, kLetters, palette::kInk, text);
  }
}

void FieldCanvas::truth(const Pose2& pose) const {
  if (isFinite(pose) && grid_.cellAt(pose.x, pose.y) >= 0)
    drawTruth(picture_, pixelX(pose.x), pixelY(pose.y), pose.theta);
}

void FieldCanvas::best(double x, double y) const {
  drawBest(picture_, pixelX(x), pixelY(y), std::max(6.0, 0.5 * zoom_ + 3.0));
}

void FieldCanvas::drawTruth(Picture& picture, double x, double y, double heading) {
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  const double far = 2.1 * kRadius;
  for (const bool halo : {true, false}) {
    const Colour colour = halo ? palette::kPaper : palette::kTruth;
    picture.ring(x, y, kRadius + (halo ? 2 : 0), halo ? 7 : 3, colour);
    picture.line(x + kRadius * c, y - kRadius * s, x + far * c, y - far * s, halo ? 7 : 3, colour);
  }
}

void FieldCanvas::drawBest(Picture& picture, double x, double y, double half) {
  for (const bool halo : {true, false}) {
    const Colour colour = halo ? palette::kPaper : palette::kBest;
    const int thick = halo ? 4 : 2;
    picture.line(x - half, y - half, x + half, y - half, thick, colour);
    picture.line(x - half, y + half, x + half, y + half, thick, colour);
    picture.line(x - half, y - half, x - half, y + half, thick, colour);
    picture.line(x + half, y - half, x + half, y + half, thick, colour);
  }
}

void FieldCanvas::drawLandmark(Picture& picture, double x, double y, int half) {
  const int middleX = nearest(x);
  const int middleY = nearest(y);
  for (const int size : {half + 1, half}) {
    const Colour colour = size > half ? palette::kPaper : palette::kLandmark;
    for (int row = -size; row <= size; ++row) {
      const int reach = size - std::abs(row);
      picture.fill(middleX - reach, middleY + row, 2 * reach + 1, 1, colour);
    }
  }
}

}  // namespace ortung::app
