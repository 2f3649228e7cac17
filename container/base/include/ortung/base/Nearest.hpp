#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Returns the word that somebody most likely meant who wrote @p word: the one that takes the
/// fewest inserted, left out, replaced or swapped letters (Damerau's distance), of equal ones the
/// first; "" if each of them would take more than a third of the longer word's letters.
ORTUNG_API std::string nearest(std::string_view word, std::span<const std::string> words);

/// Returns "; did you mean 'WORD'?" with the nearest word, or "" if none is near.
ORTUNG_API std::string didYouMean(std::string_view word, std::span<const std::string> words);

}  // namespace ortung
