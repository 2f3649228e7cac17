#include "CloudLayout.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace ortung::ros2 {
namespace {

static_assert(std::endian::native == std::endian::little, "little-endian numbers are copied");

/// Sizes of the types 1 to 8 of sensor_msgs/PointField: int8, uint8, int16, uint16, int32, uint32,
/// float32, float64.
constexpr std::array<std::uint8_t, 9> kSizes{0, 1, 1, 2, 2, 4, 4, 4, 8};

constexpr std::array<std::string_view, 3> kTimeNames{"t", "time", "timestamp"};

template <class T, bool kIsSwapped>
T numberAt(const std::uint8_t* from) {
  std::array<std::uint8_t, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if constexpr (kIsSwapped) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

template <class T, bool kIsSwapped, class Out>
void copyNumbers(const std::uint8_t* from, std::size_t step, std::span<Out> out) {
  for (Out& number : out) {
    number = static_cast<Out>(numberAt<T, kIsSwapped>(from));
    from += step;
  }
}

template <bool kIsSwapped, class Out>
void copyType(std::uint8_t type, const std::uint8_t* from, std::size_t step, std::span<Out> out) {
  switch (type) {
    case 1:
      return copyNumbers<std::int8_t, kIsSwapped>(from, step, out);
    case 2:
      return copyNumbers<std::uint8_t, kIsSwapped>(from, step, out);
    case 3:
      return copyNumbers<std::int16_t, kIsSwapped>(from, step, out);
    case 4:
      return copyNumbers<std::uint16_t, kIsSwapped>(from, step, out);
    case 5:
      return copyNumbers<std::int32_t, kIsSwapped>(from, step, out);
    case 6:
      return copyNumbers<std::uint32_t, kIsSwapped>(from, step, out);
    case PointCloud::Field::kFloat:
      return copyNumbers<float, kIsSwapped>(from, step, out);
    default:
      return copyNumbers<double, kIsSwapped>(from, step, out);
  }
}

/// Returns the unit of a time that is told as a floating-point number [s], and whether it counts
/// from 1970 on: drivers tell seconds since the cloud's stamp, or seconds, microseconds or
/// nanoseconds since 1970, which no number can be at a time (after 1973).
struct Unit {
  double seconds = 0.0;  ///< 0: unknown
  bool isSince1970 = false;
};
Unit unitOf(double time) {
  const double size = std::abs(time);
  if (size <= static_cast<double>(CloudLayout::kLongestSweep)) return {1.0, false};
  if (size >= 1e8 && size < 1e11) return {1.0, true};
  if (size >= 1e14 && size < 1e17) return {1e-6, true};
  if (size >= 1e17 && size < 1e20) return {1e-9, true};
  return {};
}

}  // namespace

std::optional<CloudLayout> CloudLayout::of(const PointCloud& cloud, std::string& why) {
  CloudLayout layout(cloud);
  if (!layout.findPlaces(why) || !layout.findRows(why)) return std::nullopt;
  layout.findTimes();
  return layout;
}

/// Finds a field whose bytes are in each point. @param why out: what is wrong with it
std::optional<CloudLayout::Column> CloudLayout::find(std::string_view name,
                                                     std::string& why) const {
  const auto field = std::find_if(cloud_->fields.begin(), cloud_->fields.end(),
                                  [&](const auto& one) { return one.name == name; });
  if (field == cloud_->fields.end()) {
    why = "found points without " + std::string(name) + ", expected fields x, y and z";
  } else if (field->type < 1 || field->type >= kSizes.size()) {
    why = "found a field " + std::string(name) + " of type " + std::to_string(field->type) +
          ", expected 1 to 8";
  } else if (std::uint64_t{field->offset} + kSizes[field->type] > cloud_->pointStep) {
    why = "found a field " + std::string(name) + " from byte " + std::to_string(field->offset) +
          " on in points of " + std::to_string(cloud_->pointStep) + " bytes, expected it within";
  } else {
    return Column{field->offset, field->type};
  }
  return std::nullopt;
}

bool CloudLayout::findPlaces(std::string& why) {
  const auto x = find("x", why);
  const auto y = x ? find("y", why) : std::nullopt;
  const auto z = y ? find("z", why) : std::nullopt;
  if (!z) return false;
  x_ = *x;
  y_ = *y;
  z_ = *z;
  return true;
}

/// Takes rows that lie in the data, whose sizes may say anything.
bool CloudLayout::findRows(std::string& why) {
  const std::uint64_t width = cloud_->width;
  const std::uint64_t height = cloud_->height;
  if (width == 0 || height == 0) return true;
  if (width * height > kMostPoints) {
    why = "found a cloud of " + std::to_string(width) + " x " + std::to_string(height) +
          " points, expected " + std::to_string(kMostPoints) + " at most";
    return false;
  }
  const std::uint64_t row = width * cloud_->pointStep;  // below 2^22 * 2^32
  // Of a single row some drivers do not tell the length.
  const std::uint64_t rowStep = height == 1 ? row : cloud_->rowStep;
  if (rowStep < row || (height - 1) * rowStep + row > cloud_->data.size()) {
    why = "found " + std::to_string(height) + " rows of " + std::to_string(width) + " points of " +
          std::to_string(cloud_->pointStep) + " bytes, " + std::to_string(rowStep) +
          " bytes apart, in " + std::to_string(cloud_->data.size()) +
          " bytes of data, expected as many as they take";
    return false;
  }
  const bool isWithoutGaps = rowStep == row;
  rows_ = isWithoutGaps ? 1 : height;
  columns_ = isWithoutGaps ? width * height : width;
  rowStep_ = rowStep;
  return true;
}

/// Returns the first number of a column that is finite and not 0; 0: there is none.
double CloudLayout::firstNumber(const Column& column) const {
  constexpr std::size_t kPiece = 256;
  std::array<double, kPiece> numbers;
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t first = 0; first < columns_; first += kPiece) {
      const std::span<double> piece(numbers.data(), std::min(kPiece, columns_ - first));
      readColumn(column, pointAt(row, first), piece);
      for (const double number : piece)
        if (std::isfinite(number) && number != 0.0) return number;
    }
  }
  return 0.0;
}

void CloudLayout::findTimes() {
  std::string ignored;  // a cloud without sound times is one without times
  std::optional<Column> column;
  for (const std::string_view name : kTimeNames)
    if (!column) column = find(name, ignored);
  if (!column) return;
  const bool isFloat = column->type >= PointCloud::Field::kFloat;
  // Whole numbers of 32 bits are nanoseconds since the stamp; shorter ones hold no time.
  if (!isFloat && kSizes[column->type] == 4) time_ = Clock{*column, 1e-9, 0.0};
  if (!isFloat) return;
  const Unit unit = unitOf(firstNumber(*column));
  if (unit.seconds == 0.0) return;
  const double begin = static_cast<double>(cloud_->header.stamp) * 1e-9;
  time_ = Clock{*column, unit.seconds, unit.isSince1970 ? begin : 0.0};
}

const std::uint8_t* CloudLayout::pointAt(std::size_t row, std::size_t first) const {
  return cloud_->data.data() + row * rowStep_ + first * cloud_->pointStep;
}

template <class Out>
void CloudLayout::readColumn(const Column& column, const std::uint8_t* from,
                             std::span<Out> out) const {
  from += column.offset;
  if (cloud_->isBigEndian)
    copyType<true>(column.type, from, cloud_->pointStep, out);
  else
    copyType<false>(column.type, from, cloud_->pointStep, out);
}

void CloudLayout::readPlaces(std::size_t row, std::size_t first, std::span<float> x,
                             std::span<float> y, std::span<float> z) const {
  const std::uint8_t* from = pointAt(row, first);
  readColumn(x_, from, x);
  readColumn(y_, from, y);
  readColumn(z_, from, z);
}

void CloudLayout::readTimes(std::size_t row, std::size_t first, std::span<float> seconds) const {
  const std::uint8_t* from = pointAt(row, first);
  constexpr std::size_t kPiece = 256;
  std::array<double, kPiece> numbers;
  for (std::size_t done = 0; done < seconds.size(); done += kPiece) {
    const std::span<double> piece(numbers.data(), std::min(kPiece, seconds.size() - done));
    readColumn(time_->column, from + done * cloud_->pointStep, piece);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const double after = piece[i] * time_->unit - time_->begin;
      const bool isWithin = std::abs(after) <= static_cast<double>(kLongestSweep);
      seconds[done + i] = isWithin ? static_cast<float>(after) : 0.0F;
    }
  }
}

Timestamp CloudLayout::stamp() const {
  const std::int64_t nanoseconds = cloud_->header.stamp;
  return nanoseconds / 1000 - (nanoseconds % 1000 < 0 ? 1 : 0);
}

CloudLayout::Sweep CloudLayout::sweep() const {
  if (!hasTimes() || columns_ == 0) return {};
  constexpr std::size_t kPiece = 256;
  std::array<float, kPiece> seconds;
  Sweep sweep{kLongestSweep, -kLongestSweep};
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t first = 0; first < columns_; first += kPiece) {
      const std::span<float> piece(seconds.data(), std::min(kPiece, columns_ - first));
      readTimes(row, first, piece);
      for (const float time : piece) {
        sweep.begin = std::min(sweep.begin, time);
        sweep.end = std::max(sweep.end, time);
      }
    }
  }
  return sweep;
}

}  // namespace ortung::ros2
