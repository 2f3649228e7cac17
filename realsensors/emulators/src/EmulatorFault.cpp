#include "ortung/emulators/EmulatorFault.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "ortung/core/SourceOptions.hpp"

namespace ortung {
namespace {

using Kind = EmulatorFault::Kind;

struct Named {
  Kind kind;
  std::string_view name;
  bool hasValue;
  std::string_view help;
};

constexpr std::array kKinds{
    Named{Kind::kUnplug, "unplug", false, "the cable is pulled, and put back"},
    Named{Kind::kSilent, "silent", false, "the device sends nothing"},
    Named{Kind::kFreeze, "freeze", false, "the device repeats its last reading"},
    Named{Kind::kGarbage, "garbage", false, "noise between telegrams, and bits that flip in them"},
    Named{Kind::kHalf, "half", false, "every other telegram ends in its middle"},
    Named{Kind::kJump, "jump", true, "SECONDS by which the device's clock is set from then on"},
    Named{Kind::kFlood, "flood", false, "the device sends each reading a thousand times"}};

[[noreturn]] void refuse(const std::string& text, const std::string& expected) {
  throw std::invalid_argument("fault '" + text + "': expected " + expected);
}

double secondsOf(const std::string& number, const std::string& text) {
  const auto numbers = parseNumbers(number);
  if (!numbers || numbers->size() != 1 || std::abs((*numbers)[0]) > 1e6)
    refuse(text, "numbers of seconds up to 1e6");
  return (*numbers)[0];
}

}  // namespace

EmulatorFault parseEmulatorFault(const std::string& text) {
  const std::size_t at = text.find('@');
  const std::string what = text.substr(0, at);
  const std::size_t colon = what.find(':');
  const std::string name = what.substr(0, colon);
  EmulatorFault fault;
  const Named* found = nullptr;
  std::string names;
  for (const Named& one : kKinds) {
    names += (names.empty() ? "" : ", ") + std::string(one.name);
    if (one.name == name) found = &one;
  }
  if (found == nullptr) refuse(text, "KIND[:VALUE][@FROM-TO] with one of " + names);
  fault.kind = found->kind;
  if (found->hasValue != (colon != std::string::npos))
    refuse(text, found->hasValue ? name + ":SECONDS" : name + " without a value");
  if (found->hasValue) fault.value = secondsOf(what.substr(colon + 1), text);
  if (at == std::string::npos) return fault;
  const std::string span = text.substr(at + 1);
  const std::size_t dash = span.find('-', 1);
  fault.from = fromSeconds(secondsOf(span.substr(0, dash), text));
  if (dash != std::string::npos) fault.to = fromSeconds(secondsOf(span.substr(dash + 1), text));
  if (fault.to <= fault.from) refuse(text, "FROM-TO with FROM before TO");
  return fault;
}

std::string emulatorFaultHelp() {
  std::string text;
  for (const Named& one : kKinds) {
    std::string name(one.name);
    if (one.hasValue) name += ":VALUE";
    name.resize(14, ' ');
    text += "  " + name + std::string(one.help) + "\n";
  }
  return text;
}

std::string damaged(std::string telegram, Kind kind, bool isOdd, Random& random) {
  if (kind == Kind::kHalf) return isOdd ? telegram.substr(0, telegram.size() / 2) : telegram;
  if (kind != Kind::kGarbage) return telegram;
  std::string noise;
  const auto count = static_cast<std::size_t>(random.uniform(0.0, 40.0));
  for (std::size_t i = 0; i < count; ++i)
    noise += static_cast<char>(static_cast<int>(random.uniform(0.0, 256.0)));
  if (isOdd && !telegram.empty()) {
    const auto place =
        static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(telegram.size())));
    telegram[place] =
        static_cast<char>(telegram[place] ^ (1 << static_cast<int>(random.uniform(0.0, 8.0))));
  }
  return noise + telegram;
}

std::string atWrongSpeed(const std::string& bytes, Random& random) {
  std::string out;
  for (const char c : bytes) {
    if (random.uniform() < 0.3) continue;  // such edges make no start bit
    out += static_cast<char>(static_cast<unsigned char>(c) ^
                             static_cast<unsigned char>(1 + random.uniform(0.0, 255.0)));
  }
  return out;
}

}  // namespace ortung
