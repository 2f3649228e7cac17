#include "ortung/formats/TalkData.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "FormatTools.hpp"
#include "TextWords.hpp"

namespace ortung {
namespace {

constexpr double kMicro = 1e6;  ///< per second

TalkData::Reading readTalk(std::span<const std::uint32_t> words) {
  TalkData::Reading reading;
  if (words.empty()) return reading;
  WordsReader reader(words);
  reading.listener = reader.text("a listener", TalkData::kLongestName);
  while (!reader.isAtEnd()) {
    if (reading.messages.size() == TalkData::kMostMessages)
      throw std::invalid_argument("found more messages than the 1000 that were expected at most");
    TalkData::Message message;
    message.age = reader.word() / kMicro;
    message.from = reader.text("a speaker", TalkData::kLongestName);
    message.text = reader.text("a message", TalkData::kLongestText);
    reading.messages.push_back(std::move(message));
  }
  return reading;
}

}  // namespace

TalkData::TalkData(SensorId id) : SensorData(std::move(id)) {}
TalkData::~TalkData() = default;

std::vector<std::uint32_t> TalkData::encode(const Reading& reading) {
  if (reading.messages.size() > kMostMessages)
    throw std::invalid_argument("found " + std::to_string(reading.messages.size()) +
                                " messages, expected at most 1000");
  checkText("a listener", reading.listener, kLongestName);
  std::vector<std::uint32_t> words;
  addTextWords(reading.listener, words);
  for (const Message& message : reading.messages) {
    checkText("a speaker", message.from, kLongestName);
    checkText("a message", message.text, kLongestText);
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    words.push_back(
        static_cast<std::uint32_t>(std::clamp(std::nearbyint(message.age * kMicro), 0.0, kMost)));
    addTextWords(message.from, words);
    addTextWords(message.text, words);
  }
  return words;
}

void TalkData::check(std::span<const std::uint32_t> words) const { readTalk(words); }
void TalkData::decode(std::span<const std::uint32_t> words) { reading_ = readTalk(words); }

Format TalkData::format() const { return Format(kFormat); }

std::string TalkData::wordsHelp() const {
  return "the listener's name, then [us ago, who, what] a message; a text is its number of bytes "
         "and these, four a word";
}

}  // namespace ortung
