#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace ortung {

/// Takes candidates one after the other, best first, until enough of them are chosen. It may be
/// spread over several calls. Not thread-safe.
/// @tparam Candidate it has isBetterThan(), a strict order
template <class Candidate>
class Choice {
 public:
  Choice(std::vector<Candidate> from, std::size_t most) : rest_(std::move(from)), most_(most) {
    std::make_heap(rest_.begin(), rest_.end(), isWorse);
  }

  /// Considers some more. @param wants says of a candidate, from those chosen before, if it is one
  /// @returns whether the choice is made
  template <class Wants>
  bool consider(std::size_t some, const Wants& wants) {
    for (; some > 0 && !rest_.empty() && chosen_.size() < most_; --some) {
      std::pop_heap(rest_.begin(), rest_.end(), isWorse);
      if (wants(rest_.back(), chosen_)) chosen_.push_back(std::move(rest_.back()));
      rest_.pop_back();
    }
    return rest_.empty() || chosen_.size() == most_;
  }
  std::vector<Candidate> take() { return std::move(chosen_); }

 private:
  static bool isWorse(const Candidate& a, const Candidate& b) { return b.isBetterThan(a); }

  std::vector<Candidate> rest_;  ///< a heap
  std::vector<Candidate> chosen_;
  std::size_t most_;
};

}  // namespace ortung
