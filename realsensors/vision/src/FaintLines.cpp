#include "FaintLines.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

constexpr int kMostGap = 1;             ///< scan lines that a chain may miss
constexpr double kSteepest = 1.2;       ///< greatest slope of a chain [px / px]; steeper lines are
                                        ///< crossed by the scan lines of the other direction
constexpr double kOff = 0.2;            ///< greatest step off a chain's direction [spacings]
constexpr double kLeastOff = 1.2;       ///< least bound of such a step [px]
constexpr double kAlike = 2.5;          ///< greatest ratio of steps, and of widths, of neighbours
constexpr int kLeastCount = 7;          ///< least number of crossings of a chain
constexpr double kLeastEvidence = 22;   ///< least sum of their evidence
constexpr double kMostEvidence = 8.0;   ///< greatest evidence of one crossing
constexpr double kLeastOfEither = 0.2;  ///< least share of red, and of blue, of a chain's rise
constexpr double kWhiter = 1.4;         ///< least rise of red and blue / that of green
constexpr double kTrust = 0.2;  ///< how much farther off a chain may be for each crossing [px]
constexpr int kSureCount = 2;   ///< crossings that are sure from which a chain needs no more

bool areAlike(double a, double b) { return a < kAlike * b && b < kAlike * a; }

}  // namespace

void FaintLines::begin(int spacing) {
  spacing_ = spacing;
  scan_ = 0;
  links_.clear();
  open_.clear();
  found_.clear();
}

/// The chain that a crossing continues best; -1: none.
int FaintLines::bestFor(const FaintCrossing& crossing) const {
  int best = -1;
  double least = 1e9;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const Chain& chain = open_[i];
    const Link& last = links_[static_cast<std::size_t>(chain.last)];
    const int scans = scan_ - last.scan;
    const double off = std::abs(crossing.middle - last.crossing.middle -
                                (chain.count > 1 ? scans * chain.slope : 0.0));
    const double most = chain.count > 1 ? scans * std::max(kLeastOff, kOff * spacing_)
                                        : scans * kSteepest * spacing_;
    // Widths of thin lines differ by a pixel by chance.
    const bool fits = off <= most && isTaken_[i] == 0 &&
                      areAlike(crossing.step, last.crossing.step) &&
                      areAlike(crossing.width + 1.0, last.crossing.width + 1.0);
    const double cost = off - kTrust * std::min(chain.count, kLeastCount);
    if (fits && cost < least) {
      least = cost;
      best = static_cast<int>(i);
    }
  }
  return best;
}

void FaintLines::add(std::span<const FaintCrossing> crossings) {
  isTaken_.assign(open_.size(), 0);
  next_.clear();
  for (const FaintCrossing& crossing : crossings) {
    const int index = static_cast<int>(links_.size());
    const int best = bestFor(crossing);
    Chain chain;
    if (best >= 0) {
      isTaken_[static_cast<std::size_t>(best)] = 1;
      chain = open_[static_cast<std::size_t>(best)];
      const Link& last = links_[static_cast<std::size_t>(chain.last)];
      const double slope = (crossing.middle - last.crossing.middle) / (scan_ - last.scan);
      chain.slope = chain.count > 1 ? 0.5 * (chain.slope + slope) : slope;
    }
    links_.push_back({crossing, scan_, chain.last});
    chain.last = index;
    ++chain.count;
    chain.sure += crossing.isSure ? 1 : 0;
    chain.red += crossing.red;
    chain.blue += crossing.blue;
    chain.paintRise += crossing.paintRise;
    chain.greenRise += crossing.greenRise;
    chain.evidence += std::min(kMostEvidence, crossing.evidence);
    next_.push_back(chain);
  }
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (isTaken_[i] != 0) continue;
    if (scan_ - links_[static_cast<std::size_t>(open_[i].last)].scan > kMostGap)
      close(open_[i]);
    else
      next_.push_back(open_[i]);
  }
  open_.swap(next_);
  ++scan_;
}

/// Paint is white: it has more red and more blue than the floor, though a pixel of a thin line may
/// have one of them alone. Light on the floor makes all channels brighter alike.
bool FaintLines::isPaint(const Chain& chain) {
  return std::min(chain.red, chain.blue) >= kLeastOfEither * (chain.red + chain.blue) &&
         chain.paintRise >= kWhiter * chain.greenRise;
}

void FaintLines::close(const Chain& chain) {
  const bool isLong = chain.count >= kLeastCount && chain.evidence >= kLeastEvidence;
  if (!isLong && chain.sure < kSureCount) return;
  if (!isPaint(chain)) return;
  for (int i = chain.last; i >= 0; i = links_[static_cast<std::size_t>(i)].before) {
    const Link& link = links_[static_cast<std::size_t>(i)];
    found_.push_back({link.crossing, link.scan});
  }
}

std::span<const FaintLines::Found> FaintLines::finish() {
  for (const Chain& chain : open_) close(chain);
  open_.clear();
  return found_;
}

}  // namespace ortung
