#include "PortableScanCost.hpp"

#include <algorithm>
#include <cstring>

// Differences are computed by loops that compilers turn into vectors of any machine. Looking up 16
// bytes at once is not among what such loops can say, but two readings fit one table.
namespace ortung {
namespace {

constexpr std::size_t kStretch = 32;          ///< readings a vectorized loop takes
constexpr std::size_t kHalf = kStretch / 2;   ///< a reading's partner is so far behind it
constexpr std::size_t kPart = 16 * kStretch;  ///< readings looked up in one go
static_assert(kScanBlock % kStretch == 0);
constexpr int kEntryBits = 5;
static_assert(kLevelDifferences == 1 << kEntryBits);

/// Returns the number of readings up to the last that counts, whole stretches of them.
std::size_t usedStretches(const ScanReading& reading) {
  std::size_t n = reading.caps.size();
  while (n > 0 && reading.caps[n - 1] == 0) --n;
  return (n + kStretch - 1) / kStretch * kStretch;
}

/// Finds where readings are in the table of costs, a part of them at a time; its loops vectorize.
class EntryFinder {
 public:
  using Entries = std::array<std::int16_t, kStretch>;

  explicit EntryFinder(const ScanReading& reading) : reading_(reading) {}

  /// Begins with a part. A product's upper 16 bits are twice a difference times its step, for
  /// rounding: vectors have no shift by a variable.
  void start(std::size_t begin, std::size_t size) {
    begin_ = begin;
    if (reading_.steps.empty()) return;
    for (std::size_t k = 0; k < size; ++k)
      factors_[k] =
          static_cast<std::uint16_t>(reading_.steps[begin + k] << (kMostShift - reading_.shift));
  }

  template <bool kHasSteps>
  Entries at(const std::uint8_t* row, std::size_t first) const {
    const std::uint8_t* levels = reading_.levels.data() + first;
    const std::uint16_t* factors = factors_.data() + (first - begin_);
    const std::int16_t last = last_;
    Entries entries;
    for (std::size_t k = 0; k < kStretch; ++k) {
      const std::uint8_t expected = row[first + k];
      const std::uint8_t more = expected > levels[k] ? expected : levels[k];
      const std::uint8_t less = expected > levels[k] ? levels[k] : expected;
      const auto difference = static_cast<std::uint8_t>(more - less);
      std::int16_t whole = difference;
      if constexpr (kHasSteps) {
        const auto upper = static_cast<std::uint16_t>(difference << 8);
        const auto twice = static_cast<std::uint16_t>((std::uint32_t{upper} * factors[k]) >> 16);
        whole = static_cast<std::int16_t>(static_cast<std::uint16_t>(twice + 1U) >> 1);
      }
      entries[k] = whole < last ? whole : last;
    }
    return entries;
  }

 private:
  static_assert(kMostShift == 9);  // 8 bits of the difference's, and one more
  const ScanReading& reading_;
  std::size_t begin_ = 0;
  std::int16_t last_ = kLevelDifferences - 1;  ///< no constant: it would be chosen, as no minimum
  /// Steps with the whole part of their products in the upper 16 bits.
  std::array<std::uint16_t, kPart> factors_;
};

/// Costs of two readings by both their entries, for each pair of caps that occurs. Readings have
/// two or three caps.
class PairedCosts {
 public:
  static constexpr std::size_t kPairs = kPart / 2;
  using Starts = std::array<std::uint16_t, kPairs>;

  explicit PairedCosts(const ScanReading& reading) : reading_(reading) {}

  /// Finds where the tables of a part's pairs start; returns false if there are too many kinds.
  bool find(std::size_t begin, std::size_t size, Starts& starts) {
    for (std::size_t pair = 0; pair < size / 2; ++pair) {
      const std::size_t j = begin + pair / kHalf * kStretch + pair % kHalf;
      const Kind kind{reading_.caps[j], reading_.caps[j + kHalf]};
      std::size_t i = 0;
      while (i < count_ && kinds_[i] != kind) ++i;
      if (i == kMost) return false;
      if (i == count_) make(kind);
      starts[pair] = static_cast<std::uint16_t>(i * kSize);
    }
    return true;
  }

  template <bool kHasSteps>
  std::uint32_t sum(const EntryFinder& finder, const std::uint8_t* row, std::size_t begin,
                    std::size_t size, const Starts& starts) const {
    Starts places;
    for (std::size_t pair = 0; pair < size / 2; pair += kHalf) {
      const EntryFinder::Entries entries = finder.at<kHasSteps>(row, begin + 2 * pair);
      std::array<std::uint16_t, kHalf> stretch;  // shares no memory with what is read
      for (std::size_t k = 0; k < kHalf; ++k)
        stretch[k] = static_cast<std::uint16_t>(starts[pair + k] + entries[k] +
                                                (entries[k + kHalf] << kEntryBits));
      std::copy(stretch.begin(), stretch.end(), places.begin() + pair);
    }
    std::uint32_t cost = 0;
    for (std::size_t pair = 0; pair < size / 2; pair += 4)
      cost += ofTwo(places.data() + pair) + ofTwo(places.data() + pair + 2);
    return cost;
  }

 private:
  struct Kind {
    std::uint8_t cap = 0;
    std::uint8_t partners = 0;
    bool operator==(const Kind&) const = default;
  };
  static constexpr std::size_t kMost = 16;
  static constexpr std::size_t kSize = kLevelDifferences * kLevelDifferences;

  /// Costs at two places, which one load takes; their order does not matter.
  std::uint32_t ofTwo(const std::uint16_t* places) const {
    std::uint32_t both = 0;
    std::memcpy(&both, places, sizeof both);
    return std::uint32_t{costs_[both & 0xFFFF]} + costs_[both >> 16];
  }

  void make(const Kind& kind) {
    std::uint16_t* table = costs_.data() + count_ * kSize;
    for (std::size_t partners = 0; partners < kLevelDifferences; ++partners) {
      const std::uint8_t cost = std::min(reading_.costs[partners], kind.partners);
      for (std::size_t own = 0; own < kLevelDifferences; ++own)
        table[partners * kLevelDifferences + own] =
            static_cast<std::uint16_t>(cost + std::min(reading_.costs[own], kind.cap));
    }
    kinds_[count_++] = kind;
  }

  const ScanReading& reading_;
  std::size_t count_ = 0;
  std::array<Kind, kMost> kinds_{};
  std::array<std::uint16_t, kMost * kSize> costs_;
};

template <bool kHasSteps>
std::uint32_t sumOneByOne(const ScanReading& reading, const EntryFinder& finder,
                          const std::uint8_t* row, std::size_t begin, std::size_t size) {
  std::uint32_t cost = 0;
  for (std::size_t first = begin; first < begin + size; first += kStretch) {
    const EntryFinder::Entries entries = finder.at<kHasSteps>(row, first);
    for (std::size_t k = 0; k < kStretch; ++k)
      cost +=
          std::min(reading.costs[static_cast<std::size_t>(entries[k])], reading.caps[first + k]);
  }
  return cost;
}

template <bool kHasSteps>
void addUp(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
           std::uint32_t* costs) {
  constexpr std::size_t kWorthTables = 8;
  const std::size_t n = usedStretches(reading);
  std::fill_n(costs, rows.size(), 0U);
  EntryFinder finder(reading);
  PairedCosts paired(reading);
  PairedCosts::Starts starts;
  bool isPaired = rows.size() >= kWorthTables;
  for (std::size_t begin = 0; begin < n; begin += kPart) {
    const std::size_t size = std::min(kPart, n - begin);
    finder.start(begin, size);
    isPaired = isPaired && paired.find(begin, size, starts);
    for (std::size_t i = 0; i < rows.size(); ++i)
      costs[i] += isPaired ? paired.sum<kHasSteps>(finder, rows[i], begin, size, starts)
                           : sumOneByOne<kHasSteps>(reading, finder, rows[i], begin, size);
  }
}

}  // namespace

void portableScanCost(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
                      std::uint32_t* costs) {
  (reading.steps.empty() ? addUp<false> : addUp<true>)(reading, rows, costs);
}

}  // namespace ortung
