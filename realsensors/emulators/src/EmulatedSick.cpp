#include "ortung/emulators/EmulatedSick.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ortung {
namespace {

constexpr unsigned char kStx = 0x02;
constexpr unsigned char kFromScanner = 0x80;
constexpr char kAck = 0x06;
constexpr char kNak = 0x15;
constexpr char kReady = 0x10;           ///< last byte of every answer: no error
constexpr std::size_t kFrame = 6;       ///< number of bytes around the data
constexpr std::size_t kMostData = 800;  ///< greatest length of the data of a telegram to it [bytes]
constexpr std::size_t kSettings = 34;   ///< length of the configuration [bytes]
constexpr std::size_t kUnits = 6;       ///< index of the unit in it: 0 cm, 1 mm
constexpr std::string_view kPassword = "SICK_LMS";
constexpr std::uint32_t kNothing = 0x1FF7;  ///< "beyond the greatest value", 13 bits
constexpr std::uint32_t kInvalid = 0x1FFF;

unsigned char at(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

void append16(std::string& bytes, std::uint32_t value) {
  bytes += static_cast<char>(value & 0xFF);
  bytes += static_cast<char>(value >> 8);
}

std::optional<int> speedOf(unsigned char mode) {
  switch (mode) {
    case 0x42:
      return 9600;
    case 0x41:
      return 19200;
    case 0x40:
      return 38400;
    case 0x48:
      return 500000;
    default:
      return std::nullopt;
  }
}

}  // namespace

// The sum is shifted once for each byte; the byte before is added again, as the high one.
std::uint16_t sickChecksum(std::string_view bytes) {
  std::uint32_t sum = 0;
  std::uint32_t before = 0;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const bool isHigh = (sum & 0x8000U) != 0;
    sum = (sum << 1) & 0xFFFFU;
    if (isHigh) sum ^= 0x8005U;
    sum ^= byte | (before << 8);
    before = byte;
  }
  return static_cast<std::uint16_t>(sum);
}

std::string sickTelegram(unsigned char address, std::string_view data) {
  std::string telegram{static_cast<char>(kStx), static_cast<char>(address)};
  append16(telegram, static_cast<std::uint32_t>(data.size()));
  telegram += data;
  append16(telegram, sickChecksum(telegram));
  return telegram;
}

EmulatedSick::EmulatedSick(const ScanData& scan, int baud)
    : id_(scan.id()), maxRange_(scan.config().maxRange), baud_(baud), settings_(kSettings, '\0') {
  const int beams = scan.config().beams;
  if (beams != 101 && beams != 181 && beams != 201 && beams != 361 && beams != 401)
    throw std::invalid_argument(toText(id_) + " has " + std::to_string(beams) +
                                " beams, a SICK 181 or 361 of 180 degrees, 101, 201 or 401 of 100");
}

std::size_t EmulatedSick::beams() const {
  return static_cast<std::size_t>(fieldOfView_ * 100 / resolution_) + 1;
}

void EmulatedSick::receive(std::string_view bytes, Timestamp now) {
  bytes_ += bytes;
  while (true) {
    const std::size_t begin = bytes_.find(static_cast<char>(kStx));
    bytes_.erase(0, std::min(begin, bytes_.size()));
    if (bytes_.size() < kFrame) return;
    const std::size_t length = at(bytes_, 2) + 256U * at(bytes_, 3);
    if (length == 0 || length > kMostData) {
      bytes_.erase(0, 1);  // this is not the begin of a telegram
      continue;
    }
    if (bytes_.size() < kFrame + length) return;
    const std::string_view telegram = std::string_view(bytes_).substr(0, kFrame + length);
    const std::uint32_t stated = at(telegram, length + 4) + 256U * at(telegram, length + 5);
    if (stated != sickChecksum(telegram.substr(0, length + 4))) {
      send(std::string(1, kNak), now);
      bytes_.erase(0, 1);
      continue;
    }
    const std::string command(telegram.substr(4, length));
    bytes_.erase(0, kFrame + length);
    send(std::string(1, kAck), now);
    execute(command, now);
  }
}

void EmulatedSick::answer(std::string data, Timestamp now) {
  data += kReady;
  send(sickTelegram(kFromScanner, data), now);
}

void EmulatedSick::execute(std::string_view command, Timestamp now) {
  using namespace std::string_literals;
  switch (at(command, 0)) {
    case 0x20:
      changeMode(command, now);
      return;
    case 0x31: {  // status: the version of its software, and its mode
      std::string status = "\xB1V02.30 "s;
      status += isContinuous_ ? '\x24' : '\x25';
      answer(status, now);
      return;
    }
    case 0x3B: {  // angles
      const int view = command.size() == 5 ? at(command, 1) : 0;
      const int step = command.size() == 5 ? at(command, 3) : 0;
      const bool isRight = (view == 100 || view == 180) &&
                           (step == 25 || step == 50 || step == 100) &&
                           !(view == 180 && step == 25);
      if (isRight) {
        fieldOfView_ = view;
        resolution_ = step;
      }
      std::string text = isRight ? "\xBB\x01"s : "\xBB\x00"s;
      append16(text, static_cast<std::uint32_t>(fieldOfView_));
      append16(text, static_cast<std::uint32_t>(resolution_));
      answer(text, now);
      return;
    }
    case 0x74:
      answer("\xF4" + settings_, now);
      return;
    case 0x77: {
      const bool isRight = isInstalling_ && command.size() == 1 + kSettings;
      if (isRight) settings_ = command.substr(1);
      answer((isRight ? "\xF7\x01"s : "\xF7\x00"s) + settings_, now);
      return;
    }
    default:
      answer("\x92"s, now);  // "incorrect command"
  }
}

void EmulatedSick::changeMode(std::string_view command, Timestamp now) {
  using namespace std::string_literals;
  const unsigned char mode = command.size() > 1 ? at(command, 1) : 0xFF;
  std::optional<int> speed;
  bool isRight = true;
  if (mode == 0x00) {
    isRight = command.substr(2) == kPassword;
    if (isRight) isInstalling_ = true;
  } else if (mode == 0x24 || mode == 0x25) {
    isContinuous_ = mode == 0x24;
    isInstalling_ = false;
  } else {
    speed = speedOf(mode);
    isRight = speed.has_value();
  }
  if (isRight && mode != 0x24) isContinuous_ = false;
  answer(isRight ? "\xA0\x00"s : "\xA0\x01"s, now);
  if (speed) baud_ = *speed;  // after the answer
}

void EmulatedSick::sense(const Message& reading, Timestamp now) {
  if (reading.id != id_ || !isContinuous_ || isBusy(now)) return;
  const bool isMillimetres = settings_[kUnits] == 1;
  const std::size_t count = std::min(beams(), reading.words.size());
  std::string data = "\xB0";
  append16(data, static_cast<std::uint32_t>(count) | (isMillimetres ? 0x4000U : 0U));
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t word = reading.words[i];
    std::uint32_t value = isMillimetres ? word : (word + 5) / 10;
    const std::uint32_t special = isMillimetres ? 0x6000U : 0U;  // 15 bits in place of 13
    if (word == 0) value = special + kInvalid;
    if (word >= std::lround(1000.0 * maxRange_)) value = special + kNothing;
    append16(data, std::min(value, special + kInvalid));
  }
  answer(data, now);
}

}  // namespace ortung
