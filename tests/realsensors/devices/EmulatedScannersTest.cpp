/// Telegrams of the emulated scanners, byte by byte as their makers' lists define them.
#include <gtest/gtest.h>

#include "ortung/base/Angles.hpp"
#include "ortung/emulators/EmulatedHokuyo.hpp"
#include "ortung/emulators/EmulatedSick.hpp"

namespace ortung {
namespace {

using namespace std::string_literals;

const SensorId kScan{"laser", "LRF", "scan"};
constexpr Timestamp kMillisecond = 1000;

ScanData scanner(int beams, double first, double step, double range = 8.0) {
  ScanData::Config config;
  config.beams = beams;
  config.firstAngle = radians(first);
  config.angleStep = radians(step);
  config.maxRange = range;
  return {kScan, {}, config};
}

/// All that a device has sent completely by a time.
std::string sent(EmulatedDevice& device, Timestamp now) {
  std::string bytes;
  for (const auto& telegram : device.takeOutput(now)) bytes += telegram.bytes;
  return bytes;
}
std::string answer(EmulatedDevice& device, const std::string& request, Timestamp now = 0) {
  device.receive(request, now);
  return sent(device, now);
}

// --- SCIP 2.0: each line ends with its sum, 6 bits behind '0' ---

std::string summed(const std::string& line) {
  unsigned sum = 0;
  for (const char c : line) sum += static_cast<unsigned char>(c);
  return line + static_cast<char>((sum % 64) + 48) + "\n";
}
std::string field(const std::string& line) {
  const std::string whole = summed(line);
  return line + ";" + whole.substr(line.size());
}
/// A number in characters of 6 bits, the highest first.
std::string coded(unsigned value, int characters) {
  std::string text;
  for (int i = 0; i < characters; ++i, value /= 64)
    text.insert(text.begin(), static_cast<char>(value % 64 + 48));
  return text;
}

TEST(Scip, HasTheExamplesOfItsSpecification) {
  EXPECT_EQ(summed("00"), "00P\n");  // the status "00" has the sum 'P', "99" has 'b'
  EXPECT_EQ(summed("99"), "99b\n");
  EXPECT_EQ(coded(5432, 3), "1Dh");
  EXPECT_EQ(coded(1234, 2), "CB");
}

/// Five steps of 90 degrees: behind, right, ahead, left would be four; here steps of 45 from -90
/// on.
struct Hokuyo : testing::Test {
  Hokuyo() : scan(scanner(5, -90, 45)), device(scan) {}
  void sense(std::vector<std::uint32_t> words, Timestamp now) {
    device.sense({0, kScan, std::move(words)}, now);
  }
  ScanData scan;
  EmulatedHokuyo device;
};

TEST_F(Hokuyo, TellsItsParameters) {
  EXPECT_EQ(answer(device, "PP\n"), "PP\n00P\n" + field("MODL:EMULATOR(Ortung)") +
                                        field("DMIN:20") + field("DMAX:8000") + field("ARES:8") +
                                        field("AMIN:0") + field("AMAX:4") + field("AFRT:2") +
                                        field("SCAN:600") + "\n");
  EXPECT_TRUE(answer(device, "VVtext\n").starts_with("VVtext\n00P\n")) << "the echo is the line";
}

TEST_F(Hokuyo, TellsItsStateAndTime) {
  device.clock.offset = 2.0;
  const std::string off = "LASR:OFF", on = "LASR:ON";
  const auto state = [&](const std::string& laser, Timestamp now) {
    return "II\n00P\n" + field(laser) + field("MESM:Normal") +
           field("TIME:" + coded(static_cast<unsigned>(2000 + now / kMillisecond), 4)) +
           field("STAT:Stable 000 no error.") + "\n";
  };
  EXPECT_EQ(answer(device, "II\n", 0), state(off, 0));
  EXPECT_EQ(answer(device, "BM\n"), "BM\n00P\n\n");
  EXPECT_EQ(answer(device, "BM\n"), "BM\n" + summed("02") + "\n") << "it is on already";
  EXPECT_EQ(answer(device, "II\n", 500 * kMillisecond), state(on, 500 * kMillisecond));
  EXPECT_EQ(answer(device, "QT\n", 550 * kMillisecond), "QT\n00P\n\n");
  EXPECT_EQ(answer(device, "II\n", 600 * kMillisecond), state(off, 600 * kMillisecond));
  EXPECT_EQ(answer(device, "TM1\n", 700 * kMillisecond),
            "TM1\n00P\n" + summed(coded(2700, 4)) + "\n");
  EXPECT_EQ(answer(device, "TM0\n", 800 * kMillisecond), "TM0\n00P\n\n");
}

// 24 bits of milliseconds begin again after 4 hours and 39 minutes.
TEST_F(Hokuyo, ItsClockBeginsAgainAfter24Bits) {
  device.clock.offset = 16777.216 + 0.005;
  EXPECT_EQ(answer(device, "TM1\n"), "TM1\n00P\n" + summed(coded(5, 4)) + "\n");
}

TEST_F(Hokuyo, RefusesWhatItDoesNotKnow) {
  const std::string unknown = summed("0E") + "\n", steps = summed("05") + "\n";
  EXPECT_EQ(answer(device, "XX\n"), "XX\n" + unknown);
  EXPECT_EQ(answer(device, "SS115200\n"), "SS115200\n" + unknown) << "a socket has no speed";
  for (const std::string line :
       {"MD0000000501000", "MD0003000201000", "MD000000040100", "MD-001000401000", "GD000000040",
        "MD00000004010a0", "GS0000000501"})
    EXPECT_EQ(answer(device, line + "\n"), line + "\n" + steps);
}

TEST_F(Hokuyo, SendsScansOfTheStepsThatItWasAskedFor) {
  EXPECT_EQ(answer(device, "MD0001000301000\n"), "MD0001000301000\n00P\n\n");
  EXPECT_TRUE(device.isMeasuring());
  sense({1, 5432, 0, 8000, 1}, 7 * kMillisecond);
  // Not valid: an error's code, 6. The greatest range: nothing seen, 65533.
  EXPECT_EQ(sent(device, 7 * kMillisecond),
            "MD0001000301000\n99b\n" + summed(coded(7, 4)) +
                summed(coded(5432, 3) + coded(6, 3) + coded(65533, 3)) + "\n");
}

// Below 20 a number is an error, so the least range is 20 mm.
TEST_F(Hokuyo, RangesAreNoErrors) {
  answer(device, "MD0000000001000\n");
  sense({3, 1, 1, 1, 1}, 0);
  EXPECT_NE(sent(device, 0).find(summed(coded(20, 3))), std::string::npos);
}

TEST_F(Hokuyo, OfAClusterTheNearestStepIsSent) {
  answer(device, "MS0000000402000\n");
  sense({900, 800, 5000, 6000, 700}, 0);
  EXPECT_EQ(sent(device, 0), "MS0000000402000\n99b\n" + summed(coded(0, 4)) +
                                 summed(coded(800, 2) + coded(4095, 2) + coded(700, 2)) + "\n")
      << "two characters hold no more than 4095";
}

TEST_F(Hokuyo, SkipsScansAndEndsAfterTheLastOne) {
  answer(device, "MD0000000001202\n");  // two scans, and two left out before each
  std::string scans;
  for (unsigned i = 1; i <= 10; ++i) {
    sense({100 + i, 1, 1, 1, 1}, 0);
    const std::string bytes = sent(device, 0);
    if (!bytes.empty()) scans += std::to_string(i) + " ";
  }
  EXPECT_EQ(scans, "3 6 ");
  EXPECT_FALSE(device.isMeasuring());
}

TEST_F(Hokuyo, GivesASingleScanIfTheLaserIsOn) {
  const std::string request = "GD0000000001\n", off = "GD0000000001\n" + summed("10") + "\n";
  sense({1000, 1, 1, 1, 1}, 0);
  EXPECT_EQ(answer(device, request), off);
  answer(device, "BM\n");
  EXPECT_EQ(answer(device, request),
            request + "00P\n" + summed(coded(0, 4)) + summed(coded(1000, 3)) + "\n");
  EmulatedHokuyo fresh(scan);
  answer(fresh, "BM\n");
  EXPECT_EQ(answer(fresh, request), off) << "it has not measured yet";
}

// Lines of data have 64 characters and a sum: 30 ranges of 3 characters are two of them.
TEST(HokuyoBlocks, DataAreCutIntoLinesOf64Characters) {
  const ScanData scan = scanner(40, -90, 4.5);
  EmulatedHokuyo device(scan);
  answer(device, "MD0000002901000\n");
  std::vector<std::uint32_t> words(40);
  std::string all;
  for (unsigned i = 0; i < 40; ++i) words[i] = 1000 + 37 * i;
  for (unsigned i = 0; i < 30; ++i) all += coded(1000 + 37 * i, 3);
  device.sense({0, kScan, words}, 0);
  EXPECT_EQ(sent(device, 0), "MD0000002901000\n99b\n" + summed(coded(0, 4)) +
                                 summed(all.substr(0, 64)) + summed(all.substr(64)) + "\n");
}

TEST(HokuyoSpeed, ChangesWhenItIsToldTo) {
  const ScanData scan = scanner(5, -90, 45);
  EmulatedHokuyo device(scan, 19200);
  device.receive("SS019200\n", 0);
  device.receive("SS115200\n", 0);
  const auto out = device.takeOutput(1'000'000);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].bytes, "SS019200\n" + summed("03") + "\n") << "it has that speed already";
  EXPECT_EQ(out[1].bytes, "SS115200\n00P\n\n");
  EXPECT_EQ(out[1].baud, 19200) << "the answer still comes at the old speed";
  EXPECT_EQ(device.baud(), 115200);
  device.receive("SS001200\n", 0);
  EXPECT_EQ(device.baud(), 115200);
}

TEST(HokuyoSpeed, ScannersWithOtherBeamsAreRefused) {
  EXPECT_THROW(EmulatedHokuyo{scanner(5, -90, 44)}, std::invalid_argument);
  EXPECT_THROW(EmulatedHokuyo{scanner(5, 45, 45)}, std::invalid_argument) << "none looks ahead";
  EXPECT_THROW(EmulatedHokuyo{scanner(5, -80, 45)}, std::invalid_argument);
}

// --- SICK LMS 2xx: STX, address, length, data, checksum; ACK before each answer ---

/// The checksum as SICK's list has it in C, over the bytes before it.
std::string withSum(const std::string& telegram) {
  unsigned crc = 0;
  unsigned char previous = 0;
  for (const char c : telegram) {
    const auto now = static_cast<unsigned char>(c);
    if ((crc & 0x8000U) != 0)
      crc = ((crc & 0x7FFFU) << 1) ^ 0x8005U;
    else
      crc <<= 1;
    crc ^= static_cast<unsigned>(now) | (static_cast<unsigned>(previous) << 8);
    previous = now;
  }
  return telegram + static_cast<char>(crc & 0xFF) + static_cast<char>(crc >> 8);
}
std::string number16(unsigned value) {
  return {static_cast<char>(value & 0xFF), static_cast<char>(value >> 8)};
}
std::string toSick(const std::string& data) {
  return withSum("\x02\x00"s + number16(static_cast<unsigned>(data.size())) + data);
}
/// An answer: its data end with the status 0x10.
std::string fromSick(const std::string& data) {
  return withSum("\x02\x80"s + number16(static_cast<unsigned>(data.size() + 1)) + data + "\x10");
}
std::string acknowledged(const std::string& data) { return "\x06" + fromSick(data); }

struct Sick : testing::Test {
  Sick() : scan(scanner(181, -90, 1)), device(scan, 38400) {}
  std::string ask(const std::string& data) {
    now += 1'000'000;  // the line is free again
    device.receive(toSick(data), now);
    return sent(device, now + 999'999);
  }
  std::string measured(const std::vector<std::uint32_t>& words) {
    now += 1'000'000;
    device.sense({0, kScan, words}, now);
    return sent(device, now + 999'999);
  }
  ScanData scan;
  EmulatedSick device;
  Timestamp now = 0;
};

TEST_F(Sick, TelegramsAreThoseOfTheList) {
  EXPECT_EQ(toSick("\x31"), "\x02\x00\x01\x00\x31\x15\x12"s);  // "status", from SICK's manual
  EXPECT_EQ(sickTelegram(0, "\x31"), "\x02\x00\x01\x00\x31\x15\x12"s);
  EXPECT_EQ(toSick("\x20\x42"), "\x02\x00\x02\x00\x20\x42\x52\x08"s);  // 9600 baud
}

TEST_F(Sick, TellsItsMode) {
  EXPECT_EQ(ask("\x31"), acknowledged("\xB1V02.30 \x25"));
  EXPECT_EQ(ask("\x20\x24"), acknowledged("\xA0\x00"s));
  EXPECT_TRUE(device.isMeasuring());
  EXPECT_EQ(ask("\x31"), acknowledged("\xB1V02.30 \x24"));
  EXPECT_EQ(ask("\x20\x25"), acknowledged("\xA0\x00"s));
  EXPECT_FALSE(device.isMeasuring());
  EXPECT_EQ(ask("\x20\x77"), acknowledged("\xA0\x01")) << "no such mode";
  EXPECT_EQ(ask("\x99"), acknowledged("\x92")) << "no such command";
}

TEST_F(Sick, ChangesItsSpeedBehindTheAnswer) {
  for (const auto& [mode, speed] :
       {std::pair{"\x42", 9600}, {"\x41", 19200}, {"\x40", 38400}, {"\x48", 500000}}) {
    const auto before = device.baud();
    now += 1'000'000;
    device.receive(toSick("\x20"s + mode), now);
    const auto out = device.takeOutput(now + 999'999);
    ASSERT_EQ(out.size(), 2u);
    EXPECT_EQ(out[1].bytes, fromSick("\xA0\x00"s));
    EXPECT_EQ(out[1].baud, before);
    EXPECT_EQ(device.baud(), speed);
  }
}

TEST_F(Sick, ChangesItsAnglesIfItHasThem) {
  const auto angles = [](unsigned view, unsigned step) {
    return "\x3B" + number16(view) + number16(step);
  };
  const auto told = [](bool isRight, unsigned view, unsigned step) {
    return acknowledged("\xBB"s + (isRight ? '\1' : '\0') + number16(view) + number16(step));
  };
  EXPECT_EQ(ask(angles(100, 25)), told(true, 100, 25));
  EXPECT_EQ(ask(angles(180, 25)), told(false, 100, 25)) << "no quarters of 180 degrees";
  EXPECT_EQ(ask(angles(90, 50)), told(false, 100, 25));
  EXPECT_EQ(ask(angles(180, 50)), told(true, 180, 50));
  EXPECT_EQ(ask("\x3B\xB4"), told(false, 180, 50)) << "too short";
}

// The configuration may be changed in the mode of installation alone, which needs the password.
TEST_F(Sick, KeepsItsSettingsUnlessTheyAreUnlocked) {
  std::string settings(34, '\0');
  EXPECT_EQ(ask("\x74"), acknowledged("\xF4" + settings));
  std::string millimetres = settings;
  millimetres[6] = 1;
  EXPECT_EQ(ask("\x77" + millimetres), acknowledged("\xF7\x00"s + settings));
  EXPECT_EQ(ask("\x20\x00SICK_LMX"s), acknowledged("\xA0\x01"));
  EXPECT_EQ(ask("\x20\x00SICK_LMS"s), acknowledged("\xA0\x00"s));
  EXPECT_EQ(ask("\x77" + millimetres.substr(1)), acknowledged("\xF7\x00"s + settings));
  EXPECT_EQ(ask("\x77" + millimetres), acknowledged("\xF7\x01" + millimetres));
  EXPECT_EQ(ask("\x74"), acknowledged("\xF4" + millimetres));
}

TEST_F(Sick, MeasuresInCentimetresOrMillimetres) {
  std::vector<std::uint32_t> words(181, 1234);
  words[1] = 1235;
  words[2] = 0;
  words[3] = 8000;
  const auto scanWith = [](unsigned head, const std::vector<unsigned>& first, unsigned rest) {
    std::string data = "\xB0" + number16(head);
    for (const unsigned one : first) data += number16(one);
    for (std::size_t i = first.size(); i < 181; ++i) data += number16(rest);
    return fromSick(data);
  };
  EXPECT_EQ(measured(words), "") << "nobody has asked";
  ask("\x20\x24");
  EXPECT_EQ(measured(words), scanWith(181, {123, 124, 0x1FFF, 0x1FF7}, 123));
  std::string settings(34, '\0');
  settings[6] = 1;
  ask("\x20\x00SICK_LMS"s);
  ask("\x77" + settings);
  EXPECT_EQ(measured(words), "") << "not in the mode of installation";
  ask("\x20\x24");
  EXPECT_EQ(measured(words), scanWith(181 | 0x4000, {1234, 1235, 0x7FFF, 0x7FF7}, 1234));
}

// While a slow line sends, the next scans are left out: 372 bytes take 97 ms at 38400 baud.
TEST_F(Sick, ASlowLineHasFewerScans) {
  ask("\x20\x24");
  now += 1'000'000;
  const std::vector<std::uint32_t> words(181, 1000);
  for (const Timestamp later : {0, 50, 96, 97}) device.sense({0, kScan, words}, now + 1000 * later);
  EXPECT_EQ(device.takeOutput(now + 1'000'000).size(), 2u);
}

TEST_F(Sick, FindsTelegramsBehindDamagedOnes) {
  std::string damaged = toSick("\x31");
  damaged[4] = '\x32';
  device.receive("noise" + damaged + toSick("\x31"), 0);
  const std::string all = sent(device, 1'000'000);
  EXPECT_EQ(all, "\x15" + acknowledged("\xB1V02.30 \x25"));
  // A length of 0 or of more than 800 bytes is no begin of a telegram.
  device.receive("\x02\x00\x00\x00"s + "\x02\x00\x21\x03"s + toSick("\x31"), 2'000'000);
  EXPECT_EQ(sent(device, 3'000'000), acknowledged("\xB1V02.30 \x25"));
  // It may come in pieces.
  for (const char c : toSick("\x31")) device.receive({&c, 1}, 4'000'000);
  EXPECT_EQ(sent(device, 5'000'000), acknowledged("\xB1V02.30 \x25"));
}

TEST(SickBeams, AreThoseOfItsFieldsOfView) {
  for (const int beams : {101, 181, 201, 361, 401})
    EXPECT_NO_THROW(EmulatedSick{scanner(beams, -90, 0.25)}) << beams;
  for (const int beams : {100, 180, 360, 182}) {
    const ScanData scan = scanner(beams, -90, 0.25);
    EXPECT_THROW(EmulatedSick{scan}, std::invalid_argument) << beams;
  }
}

}  // namespace
}  // namespace ortung
