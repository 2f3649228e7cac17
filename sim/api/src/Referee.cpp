#include "ortung/sim_api/Referee.hpp"

#include <algorithm>

#include "ortung/formats/TalkData.hpp"

namespace ortung {

Referee::~Referee() = default;

std::string toText(const RefereeEvent& event) {
  std::string text = event.what + (event.team.empty() ? "" : " " + event.team) + ": " + event.text;
  text.resize(std::min(text.size(), TalkData::kLongestText));
  std::replace_if(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace ortung
