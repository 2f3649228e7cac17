#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "ReadingMessages.hpp"

namespace ortung::ros2 {
namespace {

bool has(const std::vector<ValueKind>& row, ValueKind kind) {
  return std::find(row.begin(), row.end(), kind) != row.end();
}

bool isNumber(ValueKind kind) { return isLength(kind) || isAngle(kind); }

/// Where a row lies, in the sensor's or the robot's frame; NaN for what is not there.
struct Place {
  float x = std::numeric_limits<float>::quiet_NaN();
  float y = std::numeric_limits<float>::quiet_NaN();
};

Place placeOf(std::span<const WordValue> row) {
  Place place;
  double range = std::numeric_limits<double>::quiet_NaN();
  double bearing = range;
  for (const WordValue& one : row) {
    if (one.kind == ValueKind::kX) place.x = static_cast<float>(one.value);
    if (one.kind == ValueKind::kY) place.y = static_cast<float>(one.value);
    if (one.kind == ValueKind::kRange) range = one.value;
    if (one.kind == ValueKind::kBearing) bearing = one.value;
  }
  if (std::isnan(place.x) || std::isnan(place.y))
    place = {static_cast<float>(range * std::cos(bearing)),
             static_cast<float>(range * std::sin(bearing))};
  return place;
}

/// Behind the fields that are there already.
class CloudWriter {
 public:
  explicit CloudWriter(PointCloud& cloud) : cloud_(cloud) {}
  void addField(const std::string& name, bool isFloat) {
    cloud_.fields.push_back({name, cloud_.pointStep,
                             isFloat ? PointCloud::Field::kFloat : PointCloud::Field::kWord, 1});
    cloud_.pointStep += kBytes;
  }
  void add(float value) { append(&value); }
  void add(std::uint32_t value) { append(&value); }

 private:
  static constexpr std::uint32_t kBytes = 4;
  void append(const void* value) {
    const std::size_t end = cloud_.data.size();
    cloud_.data.resize(end + kBytes);
    std::memcpy(cloud_.data.data() + end, value, kBytes);
  }
  PointCloud& cloud_;
};

}  // namespace

RowKind rowKindOf(const Format& format) {
  const std::vector<ValueKind> row = rowOf(format);
  const bool hasRange = has(row, ValueKind::kRange);
  if (areInRobot(format) || (hasRange && has(row, ValueKind::kBearing))) return RowKind::kPlaces;
  return hasRange ? RowKind::kRanges : RowKind::kOther;
}

bool areInRobot(const Format& format) {
  const std::vector<ValueKind> row = rowOf(format);
  return has(row, ValueKind::kX) && has(row, ValueKind::kY);
}

PointCloud cloudMessage(const Message& reading, const Format& format, Header header) {
  PointCloud cloud;
  cloud.header = std::move(header);
  CloudWriter writer(cloud);
  for (const char* axis : {"x", "y", "z"}) writer.addField(axis, true);
  const std::vector<ValueKind> row = rowOf(format);
  const std::vector<std::string> names = format.list("row");
  std::vector<bool> isTold(row.size());  // but what x and y are already
  for (std::size_t i = 0; i < row.size(); ++i) {
    isTold[i] = row[i] != ValueKind::kX && row[i] != ValueKind::kY;
    if (!isTold[i]) continue;
    // Units are those of ROS, not of the words.
    const std::string name = isNumber(row[i]) ? names[i].substr(0, names[i].rfind('_')) : names[i];
    writer.addField(name, isNumber(row[i]));
  }
  const std::vector<WordValue> values = valuesOfRows(format, reading.words);
  for (std::size_t i = 0; i < values.size(); i += row.size()) {
    const std::span<const WordValue> entry = std::span(values).subspan(i, row.size());
    const Place place = placeOf(entry);
    for (const float one : {place.x, place.y, 0.0F}) writer.add(one);
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (!isTold[k]) continue;
      if (isNumber(row[k]))
        writer.add(static_cast<float>(entry[k].value));
      else
        writer.add(reading.words[i + k]);
    }
    cloud.isDense = cloud.isDense && std::isfinite(place.x) && std::isfinite(place.y);
    ++cloud.width;
  }
  cloud.rowStep = cloud.width * cloud.pointStep;
  return cloud;
}

}  // namespace ortung::ros2
