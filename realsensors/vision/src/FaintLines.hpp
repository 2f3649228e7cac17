#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ortung {

/// A place where a scan line crosses something that is a little whiter than both sides.
struct FaintCrossing {
  double middle = 0.0;     ///< [px] along the scan line
  double width = 0.0;      ///< [px]
  double step = 0.0;       ///< its whiteness less that of the whiter side
  double evidence = 0.0;   ///< step / what noise makes of it
  double red = 0.0;        ///< rise of the red channel
  double blue = 0.0;       ///< rise of the blue channel
  double paintRise = 0.0;  ///< rise of red and blue / the floor's
  double greenRise = 0.0;  ///< rise of green / the floor's
  bool isSure = false;     ///< whether the finder of lines takes it as one, too
};

/// Finds faint and thin lines: crossings too weak to be trusted alone, which follow each other
/// smoothly from scan line to scan line. Chains begin and end by hysteresis: where a chain has
/// points that are sure, few others suffice; else it has to be long. Not thread-safe.
class FaintLines {
 public:
  /// A crossing of an accepted chain.
  struct Found {
    FaintCrossing crossing;
    int scan = 0;  ///< number of its scan line
  };

  /// Begins with the first scan line of a direction. @param spacing of scan lines [px]
  void begin(int spacing);
  /// Takes the crossings of the next scan line, in any order.
  void add(std::span<const FaintCrossing> crossings);
  /// Ends a direction: the crossings of all chains that are lines.
  std::span<const Found> finish();

 private:
  struct Chain {
    int last = -1;       ///< index of its last crossing
    double slope = 0.0;  ///< movement of the middle from scan line to scan line [px]
    int count = 0;
    int sure = 0;
    double evidence = 0.0;  ///< sum over its crossings
    // The same of those that are not sure:
    double red = 0.0, blue = 0.0;
    double paintRise = 0.0, greenRise = 0.0;
  };
  struct Link {
    FaintCrossing crossing;
    int scan = 0;
    int before = -1;  ///< index of the crossing before it; -1: it is the first
  };
  int bestFor(const FaintCrossing& crossing) const;
  static bool isPaint(const Chain& chain);
  void close(const Chain& chain);

  int spacing_ = 1;
  int scan_ = 0;
  std::vector<Link> links_;
  std::vector<Chain> open_;
  std::vector<Chain> next_;
  std::vector<std::uint8_t> isTaken_;  ///< whether each open chain goes on
  std::vector<Found> found_;
};

}  // namespace ortung
