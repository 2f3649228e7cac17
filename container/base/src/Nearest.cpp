#include "ortung/base/Nearest.hpp"

#include <algorithm>
#include <vector>

namespace ortung {
namespace {

constexpr std::size_t kLongest = 256;  ///< longer words, which nobody types, are near to none

/// Returns how many letters must be inserted, left out, replaced or swapped with the next one to
/// make one word of the other.
std::size_t distanceOf(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) now[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(now);
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, replaced});
      const bool isSwapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (isSwapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
  }
  return now.back();
}

/// Whether so many letters can be a slip: a third of the longer word's, dashes of options apart; of
/// several ones fewer, since "report" is not meant by "record".
bool isNear(std::string_view word, std::string_view candidate, std::size_t distance) {
  const std::size_t dashes = word.starts_with("--") && candidate.starts_with("--") ? 2 : 0;
  const std::size_t letters = std::max(word.size(), candidate.size()) - dashes;
  return distance <= 1 ? 3 * distance <= letters : 3 * distance < letters;
}

}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> words) {
  std::string best;
  std::size_t least = kLongest;
  if (word.size() > kLongest) return best;
  for (const std::string& candidate : words) {
    if (candidate.size() > kLongest) continue;
    const bool lacksUnit = !word.empty() && candidate.starts_with(std::string(word) + "_");
    const std::size_t distance = lacksUnit ? 1 : distanceOf(word, candidate);
    if (!isNear(word, candidate, distance) || distance >= least) continue;
    best = candidate;
    least = distance;
  }
  return best;
}

std::string didYouMean(std::string_view word, std::span<const std::string> words) {
  const std::string meant = nearest(word, words);
  return meant.empty() ? "" : " (did you mean '" + meant + "'?)";
}

}  // namespace ortung
