#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "BeamRows.hpp"
#include "ortung/tables/SurfaceField.hpp"

namespace ortung {

/// Finds the surface that each beam shows. This is the one nearest to the beam's end but where the
/// beam would have to cross another one well before: noise moves ends through thin walls, and the
/// far side of a wall is no place where a beam ends.
class ShownSurfaces {
 public:
  /// @param surfaces borrowed, not empty
  explicit ShownSurfaces(const SurfaceField& surfaces) : surfaces_(surfaces) {}

  void find(const BeamRows& beams);
  /// Whether a surface is near a beam's end.
  bool has(std::size_t beam) const { return numbers_[0][beam] >= 0; }
  bool isLine(std::size_t beam) const { return surfaceOf(beam).along < 0.0F; }
  /// Numbers of the surfaces; -1: none.
  const std::int32_t* numbers() const { return numbers_[0].data(); }

 private:
  static constexpr std::size_t kStep = 2;  ///< distance between places on a beam [cells]
  /// Places on a beam at which surfaces are near that it may cross, its end among them.
  static constexpr std::size_t kPlaces = 1 + SurfaceField::kReach / kStep;
  template <class Value>
  using Row = BeamRows::Row<Value>;

  const Surface& surfaceOf(std::size_t beam) const {
    return surfaces_.surfaces()[static_cast<std::size_t>(numbers_[0][beam])];
  }
  void lookUp(const BeamRows& beams);

  const SurfaceField& surfaces_;
  std::array<Row<std::int32_t>, kPlaces> columns_;
  std::array<Row<std::int32_t>, kPlaces> rows_;
  /// Numbers of the surfaces near the places, from the end on backwards; at last, those shown come
  /// first. -1: none is near, so what lies before it is not looked at.
  std::array<Row<std::int32_t>, kPlaces> numbers_;
};

}  // namespace ortung
