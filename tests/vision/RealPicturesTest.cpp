/// Pictures of real robots (../shared/data/robocup_ml), beside lines that were marked by hand.
#include <gtest/gtest.h>

#include "MarkedLines.hpp"
#include "Paths.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/vision/LineFinder.hpp"

namespace ortung {
namespace {

namespace fs = std::filesystem;

const fs::path kPictures = fs::path(ORTUNG_SHARED_DATA) / "robocup_ml";
const fs::path kMarks = fs::path(ORTUNG_SOURCE_DIR) / "tests/data/vision/robocup_ml_lines.json";

struct Score {
  std::size_t right = 0, wrong = 0;  ///< points that were found
  std::size_t seen = 0, missed = 0;  ///< places on marked lines, 6 px apart
};

Score scoreOf(const MarkedPicture& marks, std::span<const LinePoint> points) {
  constexpr double kOff = 2.0;    // of marks and points [px]
  constexpr double kNear = 12.0;  // two scan lines
  Score score;
  for (const LinePoint& point : points) {
    if (marks.distanceTo(point.pixel) <= kOff)
      ++score.right;
    else if (!marks.isUnsure(point.pixel))
      ++score.wrong;
  }
  marks.eachPiece([&](const MarkedPicture::Vertex& a, const MarkedPicture::Vertex& b) {
    const double length = std::hypot(b.u - a.u, b.v - a.v);
    for (double d = 0.0; d < length; d += 6.0) {
      const double u = a.u + d / length * (b.u - a.u);
      const double v = a.v + d / length * (b.v - a.v);
      const bool isSeen = std::any_of(points.begin(), points.end(), [&](const LinePoint& p) {
        return std::hypot(p.pixel.u - u, p.pixel.v - v) <= kNear;
      });
      ++(isSeen ? score.seen : score.missed);
    }
  });
  return score;
}

TEST(RealPictures, LinePointsLieOnLinesThatWereMarkedByHand) {
  if (!fs::exists(kPictures)) GTEST_SKIP() << kPictures << " is absent";
  Score all;
  for (const MarkedPicture& marks : readMarks(kMarks)) {
    const Picture picture = readPicture(kPictures / marks.file);
    const ImageView view = picture.view();
    LineFinder finder({});
    const Score score = scoreOf(marks, finder.find(view, ColourTable(findColours({&view, 1}))));
    std::printf("%-40s precision %.3f of %3zu, recall %.2f\n", marks.file.c_str(),
                static_cast<double>(score.right) / static_cast<double>(score.right + score.wrong),
                score.right + score.wrong,
                static_cast<double>(score.seen) / static_cast<double>(score.seen + score.missed));
    all.right += score.right;
    all.wrong += score.wrong;
    all.seen += score.seen;
    all.missed += score.missed;
  }
  const double precision =
      static_cast<double>(all.right) / static_cast<double>(all.right + all.wrong);
  const double recall = static_cast<double>(all.seen) / static_cast<double>(all.seen + all.missed);
  std::printf("all: precision %.3f, recall %.3f\n", precision, recall);
  EXPECT_GT(all.right, 500U);
  EXPECT_GT(precision, 0.98);
  EXPECT_GT(recall, 0.84);
}

}  // namespace
}  // namespace ortung
