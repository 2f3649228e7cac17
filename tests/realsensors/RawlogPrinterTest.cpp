// What the program that links MRPT prints of objects made here.
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdlib>
#include <cstring>
#include <limits>

#include "LogTesting.hpp"
#include "RawlogPrinter.hpp"
#include "ortung/base/HelperProgram.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

/// What is printed of @p scans.
std::string printed(const std::vector<mrpt::obs::CObservation2DRangeScan>& scans) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = ::open_memstream(&text, &size);
  RawlogPrinter printer(out);
  for (const mrpt::serialization::CSerializable& scan : scans) printer.print(scan);
  printer.finish();
  std::fclose(out);
  std::string all(text, size);
  std::free(text);
  return all;
}

mrpt::obs::CObservation2DRangeScan scanOf(const std::vector<float>& ranges, double seconds) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.timestamp = mrpt::Clock::fromDouble(seconds);
  scan.aperture = 2.0F;
  scan.maxRange = 8.0F;
  scan.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan.setScanRange(i, ranges[i]);
    scan.setScanRangeValidity(i, true);
  }
  return scan;
}

TEST(RawlogPrinter, PassesOverScansWithoutBeams) {
  const auto empty = scanOf({}, 1.0);
  const auto scan = scanOf({1.0F, 2.0F, 3.0F}, 2.0);
  const std::string expected =
      "# scanner 0 0 0 -1 1 8 3\n2000000 laser/LRF/scan 3 1000 2000 3000\n";
  EXPECT_EQ(printed({empty, scan}), expected + "# skipped 1 scans without beams\n# end 1\n");
  EXPECT_EQ(printed({scan, empty, empty}), expected + "# skipped 2 scans without beams\n# end 1\n");
}

/// A grid's bytes as MRPT writes them, with @p value in place of @p old.
std::string gridWith(float old, float value) {
  const mrpt::maps::COccupancyGridMap2D map(-3.0F, 3.0F, -2.0F, 4.0F, 0.25F);
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << map;
  std::string bytes(static_cast<const char*>(stream.getRawBufferData()),
                    stream.getTotalBytesCount());
  std::string pattern(sizeof old, '\0');
  std::memcpy(pattern.data(), &old, sizeof old);
  const std::size_t at = bytes.find(pattern);
  EXPECT_NE(at, bytes.npos);
  if (at != bytes.npos) std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

TEST(MrptReader, RefusesGridsWithoutAPlaceOrSize) {
  const TemporaryFolder folder;
  const auto print = [&](float old, float value) {
    const auto file = folder.write("a.gridmap", gridWith(old, value)).string();
    return runHelper(findHelper("ortung-mrpt-reader", ""), {"gridmap", file}, "grid", 1 << 22);
  };
  EXPECT_TRUE(print(-3.0F, -3.0F).starts_with("ortung-gridmap 24 24 0.25 -3 -2\n"));
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  for (const auto& [old, value] :
       {std::pair{-3.0F, kNan}, std::pair{-3.0F, kEndless}, std::pair{-2.0F, kNan},
        std::pair{-2.0F, -kEndless}, std::pair{0.25F, kNan}, std::pair{0.25F, 0.0F},
        std::pair{0.25F, -0.25F}}) {
    const std::string error = errorOf([&, o = old, v = value] { print(o, v); });
    EXPECT_TRUE(error.starts_with("grid: ortung-mrpt-reader ended with status 1: "))
        << old << " " << value << ": " << error;
  }
}

}  // namespace
}  // namespace ortung
