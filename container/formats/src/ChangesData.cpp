#include "ortung/formats/ChangesData.hpp"

#include <algorithm>
#include <stdexcept>

#include "FormatTools.hpp"
#include "ShareWords.hpp"

namespace ortung {
namespace {

constexpr std::uint32_t kWidest = 1000;  // [mm]
constexpr std::size_t kWords = 6;        // words of one cell

SensorId ownId() { return {"mcl", "LOCALIZATION", "map"}; }

}  // namespace

ChangesData::ChangesData() : SensorData(ownId()) {}
ChangesData::~ChangesData() = default;

std::vector<std::uint32_t> ChangesData::encode(const Reading& reading) {
  std::vector<std::uint32_t> words{words::fromMetres(reading.cell)};
  const auto add = [&](bool areSure) {
    for (const Cell& cell : reading.cells)
      if (cell.isSure == areSure && words.size() < kMostCells * kWords)
        words.insert(words.end(),
                     {cell.isNew ? 1U : 0U, cell.isSure ? 1U : 0U, words::fromSignedMetres(cell.x),
                      words::fromSignedMetres(cell.y), cell.passes, cell.against});
  };
  add(true);
  add(false);
  return words;
}

Message ChangesData::message(Timestamp stamp, const Reading& reading) {
  return {stamp, ownId(), encode(reading)};
}

ChangesData::Reading ChangesData::reading() const {
  const std::span<const std::uint32_t> words = getData();
  Reading reading;
  if (words.empty()) return reading;
  reading.cell = words::toMetres(words[0]);
  for (std::size_t i = 1; i + kWords <= words.size(); i += kWords)
    reading.cells.push_back({words[i] == 1, words[i + 1] == 1, words::toSignedMetres(words[i + 2]),
                             words::toSignedMetres(words[i + 3]), words[i + 4], words[i + 5]});
  return reading;
}

Format ChangesData::format() const { return Format(kFormat); }

std::string ChangesData::wordsHelp() const {
  return "edge of a cell mm, then [0 a wall is gone or 1 something is new, 1 if that is sure, x mm "
         "+ 2^31, y mm + 2^31, passes in which it was found so, passes in which it was not] a cell "
         "where readings contradict the map";
}

void ChangesData::check(std::span<const std::uint32_t> words) const {
  if (words.empty())
    throw std::invalid_argument("found no words, expected the edge of a cell first");
  if (words[0] == 0 || words[0] > kWidest)
    throw std::invalid_argument("found cells of " + std::to_string(words[0]) +
                                " mm, expected 1 to 1000");
  static_assert(kMostCells == 5'000);
  checkEntries(words.subspan(1), kWords, kMostCells,
               "one, and then six a cell and at most 5000 cells");
  for (std::size_t i = 1; i < words.size(); i += kWords) {
    checkAtMost("kind of change", words[i], 1);
    checkAtMost("sign of being sure", words[i + 1], 1);
  }
}

}  // namespace ortung
