#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/formats/PoseFixData.hpp"

namespace ortung {

/// The words of a fix, see PoseFixData.
inline constexpr std::size_t kWordsAFix = 9;

void addFixWords(const PoseFixData::Fix& fix, std::vector<std::uint32_t>& words);
/// @throws std::invalid_argument
void checkFixWords(std::span<const std::uint32_t> words);
/// @pre checkFixWords()
PoseFixData::Fix fixIn(std::span<const std::uint32_t> words);

}  // namespace ortung
