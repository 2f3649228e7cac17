#include "TableWeigher.hpp"

#include <algorithm>
#include <cstring>

#include "IndexPair.hpp"
#include "TablePlaces.hpp"
#include "ortung/base/Widest.hpp"
#ifdef ORTUNG_X86
#include <immintrin.h>
#endif

namespace ortung {
namespace {

constexpr std::size_t kPosesAtOnce = 4;
static_assert(TableWeigher::kBlock % kPosesAtOnce == 0);

/// Loads pairs of entries for kPosesAtOnce poses, and parts them.
ORTUNG_INLINE void takePairs(const std::uint32_t* entries, const std::uint32_t* entryOf,
                             std::uint32_t* own, std::uint32_t* right) {
#ifdef ORTUNG_X86
  const auto two = [&](std::size_t k) {
    const auto* first = reinterpret_cast<const __m128i*>(entries + entryOf[k]);
    const auto* second = reinterpret_cast<const __m64*>(entries + entryOf[k + 1]);
    return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(first)), second);
  };
  const __m128 early = two(0);
  const __m128 late = two(2);
  _mm_storeu_ps(reinterpret_cast<float*>(own), _mm_shuffle_ps(early, late, 0x88));
  _mm_storeu_ps(reinterpret_cast<float*>(right), _mm_shuffle_ps(early, late, 0xDD));
#else
  for (std::size_t k = 0; k < kPosesAtOnce; ++k) {
    own[k] = entries[entryOf[k]];
    right[k] = entries[entryOf[k] + 1];
  }
#endif
}

}  // namespace

void TableWeigher::start(const SensorPoses& poses, std::size_t n, float* out,
                         const LandmarkLevels* landmarks) {
  poses_ = poses;
  n_ = n;
  out_ = out;
  landmarks_ = landmarks;
  corners_.start(poses, n);
  std::int32_t least = 0;
  for (std::size_t k = 0; k < n; ++k) least = std::min(least, corners_.own(k));
  isPartlyOutside_ = least < 0;
  if (landmarks != nullptr) startList(*landmarks);
  std::copy_n(out, n, sums_.begin());
  if (n < kBlock) sums_[n] = 0.0F;  // the partner of the last one
}

/// Finds the entries of poses, and poses around which some landmark is unknown.
void TableWeigher::startList(const LandmarkLevels& landmarks) {
  const std::uint8_t* isWhole = landmarks.isWhole();
  std::size_t count = 0;
  for (std::size_t k = 0; k < n_; ++k) {
    const std::int32_t cell = corners_.lowest(k);
    entryOf_[k] = landmarks.placeOf(cell);
    suspects_[count] = static_cast<std::uint32_t>(k);  // stays if it is one: no branch
    count += static_cast<std::size_t>(isWhole[cell] == 0) |
             static_cast<std::size_t>(corners_.own(k) < 0);
  }
  suspectCount_ = count;
  std::fill_n(entryOf_.begin() + n_, (kBlock - n_) % kPosesAtOnce, 0U);
}

/// Poses near a cell of which nothing is known. They are placed by their own cells alone: as if all
/// four cells around them were alike.
struct TableWeigher::Alone {
  std::array<std::uint32_t, kBlock + 1> poseOf;
  std::size_t count = 0;
  Words own;  ///< what is known of their own cells

  void addIf(bool isUnknown, std::int32_t cell, std::size_t k) {
    poseOf[count] = static_cast<std::uint32_t>(k);  // no branch here, either
    count += static_cast<std::size_t>(isUnknown) | static_cast<std::size_t>(cell < 0);
  }
};

/// Finds places of one more feature. @param ownOf what is known of a cell, as Corners have it
template <class Places, class Corners, class OwnOf, class... Arguments>
void TableWeigher::place(const GaussianTable& gaussian, const Corners& corners, OwnOf ownOf,
                         Arguments... arguments) {
  Words& places = nextPlaces(gaussian);
  std::int32_t most = 0;
  runWidest<Places>(
      AroundPoses<Corners>{corners, corners_.sharesX(), corners_.sharesY(), poses_.theta},
      arguments..., n_, places.data(), &most);
  const bool hasUnknown = Corners::kMarksUnknown ? most == kNoLevel : suspectCount_ > 0;
  if (!hasUnknown && !isPartlyOutside_) return;
  Alone alone;
  if constexpr (Corners::kMarksUnknown) {
    for (std::size_t k = 0; k < n_; ++k) alone.addIf(places[k] >= kIsUnknown, corners_.own(k), k);
  } else {
    for (std::size_t i = 0; i < suspectCount_; ++i) {
      const std::size_t k = suspects_[i];
      alone.addIf(corners.at(k).most() == kNoLevel, corners_.own(k), k);
    }
  }
  for (std::size_t i = 0; i < alone.count; ++i) {
    const std::int32_t cell = corners_.own(alone.poseOf[i]);
    alone.own[i] = cell < 0 ? ~0U : ownOf(cell);
  }
  placeAlone<Places, Corners>(alone, places, arguments...);
}

template <class Places, class Corners, class... Arguments>
void TableWeigher::placeAlone(const Alone& alone, Words& places, Arguments... arguments) const {
  std::array<float, kBlock> theta;
  for (std::size_t i = 0; i < alone.count; ++i) theta[i] = poses_.theta[alone.poseOf[i]];
  static constexpr std::array<float, kBlock> kAnywhere{};
  Words found;
  std::int32_t most = 0;
  runWidest<Places>(AroundPoses<Corners>{Corners::alike(alone.own.data()), kAnywhere.data(),
                                         kAnywhere.data(), theta.data()},
                    arguments..., alone.count, found.data(), &most);
  for (std::size_t i = 0; i < alone.count; ++i) places[alone.poseOf[i]] = found[i] & ~kIsUnknown;
}

template <class Places, class... Arguments>
void TableWeigher::add(const CellTable& table, const GaussianTable& gaussian,
                       Arguments... arguments) {
  const std::uint16_t* levels = table.levels().data();
  take(levels);
  const auto ownOf = [levels](std::int32_t cell) {
    return levels == nullptr ? ~0U : levels[cell] * 0x10001U;
  };
  place<Places>(gaussian, TableCorners{words_[0].data(), words_[1].data()}, ownOf, arguments...);
}

void TableWeigher::addLandmark(std::size_t index, float metresPerLevel, const Reading& range,
                               const Reading& bearing) {
  const std::uint32_t* entries = landmarks_->entries() + 2 * index;
  takeEntries(entries);
  const auto ownOf = [&](std::int32_t cell) { return entries[landmarks_->placeOf(cell)]; };
  const std::uint32_t* first = words_[0].data();
  const std::uint32_t* right = words_[1].data();
  const std::uint32_t* up = words_[2].data();
  const std::uint32_t* both = words_[3].data();
  place<DistancePlaces>(range.gaussian, RangeCorners{first, right, up, both}, ownOf, range.value,
                        metresPerLevel, GaussianPlaces(range.perSigma));
  place<BearingPlaces>(bearing.gaussian, BearingCorners{first, right, up, both}, ownOf,
                       bearing.value, GaussianPlaces(bearing.perSigma));
}

void TableWeigher::addDistance(const PositionTable& table, const GaussianTable& gaussian,
                               float reading, float perSigma) {
  add<DistancePlaces>(table.cells(), gaussian, reading, static_cast<float>(table.metresPerLevel()),
                      GaussianPlaces(perSigma));
}

void TableWeigher::addBearing(const BearingTable& table, const GaussianTable& gaussian,
                              float reading, float perSigma) {
  add<BearingPlaces>(table.cells(), gaussian, reading, GaussianPlaces(perSigma));
}

void TableWeigher::finish() {
  lookUpPending();
  std::copy_n(sums_.begin(), n_, out_);
}

/// Loads the levels around all poses, two at a time.
void TableWeigher::take(const std::uint16_t* levels) {
  if (levels == nullptr) {  // nobody learned it
    words_[0].fill(0xFFFFFFFF);
    words_[1].fill(0xFFFFFFFF);
    return;
  }
  const std::int32_t up = corners_.up();
  if (corners_.right() == 1) {
    for (std::size_t k = 0; k < n_; ++k) {
      const std::uint16_t* corner = levels + corners_.lowest(k);
      std::memcpy(&words_[0][k], corner, sizeof words_[0][k]);
      std::memcpy(&words_[1][k], corner + up, sizeof words_[1][k]);
    }
  } else {
    for (std::size_t k = 0; k < n_; ++k) {
      const std::uint16_t* corner = levels + corners_.lowest(k);
      words_[0][k] = corner[0] * 0x10001U;
      words_[1][k] = corner[up] * 0x10001U;
    }
  }
}

/// Loads a landmark's entries around all poses, two at a time.
void TableWeigher::takeEntries(const std::uint32_t* entries) {
  const std::uint32_t* above = entries;
  if (corners_.up() > 0) above += landmarks_->placeOf(corners_.up());
  const std::size_t n = n_;
  for (std::size_t k = 0; k < n; k += kPosesAtOnce) {
    takePairs(entries, entryOf_.data() + k, words_[0].data() + k, words_[1].data() + k);
    takePairs(above, entryOf_.data() + k, words_[2].data() + k, words_[3].data() + k);
  }
}

/// Returns where places of one more feature go.
TableWeigher::Words& TableWeigher::nextPlaces(const GaussianTable& gaussian) {
  if (pending_ == kFeatures) lookUpPending();
  gaussians_[pending_] = &gaussian;
  Words& places = places_[pending_++];
  if (n_ < kBlock) places[n_] = 0;  // may be looked up as the partner of the last one
  return places;
}

/// Adds what kCount features say, beginning with one of those that are pending.
template <std::size_t kCount>
void TableWeigher::lookUp(std::size_t first) {
  for (std::size_t k = 0; k < n_; k += 2) {
    float one = sums_[k];
    float other = sums_[k + 1];
    for (std::size_t feature = first; feature < first + kCount; ++feature) {
      const auto places = IndexPair::at(places_[feature].data() + k);
      one += gaussians_[feature]->atPlace(static_cast<int>(places.first));
      other += gaussians_[feature]->atPlace(static_cast<int>(places.second));
    }
    sums_[k] = one;
    sums_[k + 1] = other;
  }
}

void TableWeigher::lookUpPending() {
  if (pending_ == kFeatures)
    lookUp<kFeatures>(0);
  else
    for (std::size_t feature = 0; feature < pending_; ++feature) lookUp<1>(feature);
  pending_ = 0;
}

}  // namespace ortung
