#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung {

/// A world of landmarks alone: what logs of beacons come from. Its bounds reach a margin beyond
/// them. Not thread-safe.
class ORTUNG_API OpenWorld {
 public:
  /// @param kind of the landmarks, e.g. "beacon" @param margin [m]
  OpenWorld(std::string kind, double margin) : kind_(std::move(kind)), margin_(margin) {}

  /// A landmark whose coordinates [m] are fields @p x and the one or, with @p hasHeight, two
  /// behind it, @p step fields apart.
  /// @throws std::runtime_error for an identity that is already there, or more than 256 of them
  void read(const LogFile& file, std::uint32_t identity, std::size_t x, std::size_t step = 1,
            bool hasHeight = false);

  /// A landmark at a place [m] that the file's line tells. @throws as read()
  void add(const LogFile& file, std::uint32_t identity, double x, double y);

  bool has(std::uint32_t identity) const;
  bool isEmpty() const { return landmarks_.empty(); }
  const std::string& kind() const { return kind_; }
  std::string identities() const;  ///< "1, 2, 7": as they were read
  /// Longest distance within the bounds [m].
  double diagonal() const;
  /// The world as TOML. @throws std::runtime_error
  void write(const std::filesystem::path& file) const;

 private:
  struct Place {
    std::uint32_t identity;
    double x, y;              ///< [m]
    std::optional<double> z;  ///< [m]
  };
  struct Bounds {
    double xLow, xHigh, yLow, yHigh;  ///< [m]
  };
  void add(const LogFile& file, const Place& place);
  Bounds bounds() const;

  std::string kind_;
  double margin_;
  std::vector<Place> landmarks_;
};

}  // namespace ortung
