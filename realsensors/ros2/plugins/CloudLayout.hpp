#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "ortung/base/Time.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// Where the coordinates and times of a cloud's points are in its bytes, which are not trusted:
/// fields in any order and of any numeric type, padding in and behind points and rows, either byte
/// order. Other fields, such as the ring and the intensity, are passed over. Valid as long as the
/// cloud.
class CloudLayout {
 public:
  static constexpr std::size_t kMostPoints = std::size_t{1} << 22;  ///< of a cloud
  static constexpr float kLongestSweep = 1.0F;                      ///< [s]

  /// @param why out: what was found and expected, if nothing is returned
  static std::optional<CloudLayout> of(const PointCloud& cloud, std::string& why);

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }  ///< points of a row
  /// Whether points have a time of their own whose meaning is known.
  bool hasTimes() const { return time_.has_value(); }
  /// The cloud's stamp [us].
  Timestamp stamp() const;
  /// When a sweep was measured, after the stamp [s]; zeros without times.
  struct Sweep {
    float begin = 0.0F, end = 0.0F;
  };
  Sweep sweep() const;

  /// Reads coordinates [m] of as many points of a row as the spans have, from one on. What is no
  /// number, or no place, is NaN or infinite.
  /// @pre row < rows(), first + x.size() <= columns(), all spans have one size
  void readPlaces(std::size_t row, std::size_t first, std::span<float> x, std::span<float> y,
                  std::span<float> z) const;
  /// Reads how much later than the cloud's stamp points were measured [s]; 0 for what is no number
  /// or longer than a sweep takes. @pre as above, hasTimes()
  void readTimes(std::size_t row, std::size_t first, std::span<float> seconds) const;

 private:
  struct Column {
    std::uint32_t offset = 0;
    std::uint8_t type = 0;
  };
  /// What a time means: seconds after the stamp = number * unit - begin.
  struct Clock {
    Column column;
    double unit = 1.0, begin = 0.0;
  };
  explicit CloudLayout(const PointCloud& cloud) : cloud_(&cloud) {}
  std::optional<Column> find(std::string_view name, std::string& why) const;
  bool findPlaces(std::string& why);
  bool findRows(std::string& why);
  void findTimes();
  double firstNumber(const Column& column) const;
  const std::uint8_t* pointAt(std::size_t row, std::size_t first) const;
  template <class Out>
  void readColumn(const Column& column, const std::uint8_t* from, std::span<Out> out) const;

  const PointCloud* cloud_;
  std::size_t rows_ = 0, columns_ = 0, rowStep_ = 0;
  Column x_, y_, z_;
  std::optional<Clock> time_;
};

}  // namespace ortung::ros2
