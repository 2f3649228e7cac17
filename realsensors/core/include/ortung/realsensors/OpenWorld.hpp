#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung {

/// A world that consists of landmarks, for logs of beacons. Its bounds are the landmarks' bounding
/// box and a margin around it. Not thread-safe.
class ORTUNG_API OpenWorld {
 public:
  /// @param kind   kind of the landmarks, e.g. "beacon"
  /// @param margin distance from the outermost landmarks to the bounds [m]
  OpenWorld(std::string kind, double margin) : kind_(std::move(kind)), margin_(margin) {}

  /// Adds a landmark whose coordinates x, y and, with @p hasHeight, z [m] are fields of the current
  /// line, the first one @p x, each @p step fields behind the last.
  /// @throws std::runtime_error for an identity that is already there, or more than 256 landmarks
  void read(const LogFile& file, std::uint32_t identity, std::size_t x, std::size_t step = 1,
            bool hasHeight = false);

  /// Adds a landmark at a place [m] of the current line. @throws std::runtime_error as read() does
  void add(const LogFile& file, std::uint32_t identity, double x, double y);

  /// Whether there is a landmark with this identity.
  bool has(std::uint32_t identity) const;
  bool isEmpty() const { return landmarks_.empty(); }
  const std::string& kind() const { return kind_; }
  std::string identities() const;  ///< identities in the order of reading, e.g. "1, 2, 7"
  /// Returns the longest distance within the bounds [m].
  double diagonal() const;
  /// Writes the world as TOML. @throws std::runtime_error if there is no landmark
  void write(const std::filesystem::path& file) const;

 private:
  struct Place {
    std::uint32_t identity;
    double x, y;              ///< place in the field frame [m]
    std::optional<double> z;  ///< height, if it is known [m]
  };
  struct Bounds {
    double xLow, xHigh, yLow, yHigh;  ///< bounds in the field frame [m]
  };
  void add(const LogFile& file, const Place& place);
  Bounds bounds() const;  ///< bounding box of the landmarks, with the margin

  std::string kind_;
  double margin_;                 ///< distance from the outermost landmarks to the bounds [m]
  std::vector<Place> landmarks_;  ///< landmarks in the order of reading
};

}  // namespace ortung
