/// ortung-mrpt-device: runs one of MRPT's drivers and prints what it reads, for programs that
/// neither load its 330 libraries nor trust it with bytes from a line.
///   ortung-mrpt-device sick PORT BAUD VIEW RESOLUTION UNIT    [degrees], [1/100 degree], mm or cm
///   ortung-mrpt-device hokuyo PORT                             a serial port, or tcp:HOST:PORT
/// It prints "# open" once the device measures, then lines of a record for mrpt/device/scan:
/// words are first angle [2^31 + 1e-8 rad], angle between beams [1e-8 rad], whether stamps are the
/// device's own (1) or its arrival (0), and ranges [mm], 0: not valid, 4294967295: nothing seen.
/// On an error it prints "# error WHAT" and ends with status 1.

#include <mrpt/hwdrivers/CHokuyoURG.h>
#include <mrpt/hwdrivers/CSickLaserSerial.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/core/ReadingLine.hpp"

namespace ortung {
namespace {

using mrpt::obs::CObservation2DRangeScan;
constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();
constexpr int kSilentLooks = 200;  ///< consecutive reads (>= 10 ms) without a scan: error

/// MRPT writes to the standard output, too, so this program's output gets a descriptor of its own.
std::FILE* ownOutput() {
  const int copy = dup(STDOUT_FILENO);
  std::FILE* const out = copy < 0 ? nullptr : fdopen(copy, "wb");
  if (!out || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) throw std::runtime_error("no output");
  return out;
}

int numberOf(const std::string& text) {
  int number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || rest != text.data() + text.size())
    throw std::runtime_error("'" + text + "': expected a number");
  return number;
}

/// A driver of MRPT, and how its scans are read.
class Scanner {
 public:
  virtual ~Scanner() = default;
  virtual mrpt::hwdrivers::C2DRangeFinderAbstract& driver() = 0;
  virtual bool start() = 0;
  virtual bool hasClock() const = 0;
  /// Angle of the first beam in the scanner's frame [rad].
  virtual double firstAngle(std::size_t beams) const = 0;
  virtual double angleStep(std::size_t beams) const = 0;
  virtual std::uint32_t wordOf(float metres) const = 0;
};

class Sick : public Scanner {
 public:
  Sick(const std::string& port, int baud, int view, int resolution, bool isMillimetres)
      : view_(view), resolution_(resolution), isMillimetres_(isMillimetres) {
    sick_.setSerialPort(port);
    sick_.setBaudRate(baud);
    sick_.setScanFOV(view);
    sick_.setScanResolution(resolution);
    sick_.setMillimeterMode(isMillimetres);
  }
  mrpt::hwdrivers::C2DRangeFinderAbstract& driver() override { return sick_; }
  bool start() override {
    sick_.initialize();  // throws what is wrong
    return true;
  }
  bool hasClock() const override { return false; }
  double firstAngle(std::size_t beams) const override {
    if (beams != static_cast<std::size_t>(view_ * 100 / resolution_) + 1)
      throw std::runtime_error("the scanner gives " + std::to_string(beams) + " beams, expected " +
                               std::to_string(view_ * 100 / resolution_ + 1));
    return -0.5 * view_ * std::numbers::pi / 180.0;
  }
  double angleStep(std::size_t) const override {
    return 0.01 * resolution_ * std::numbers::pi / 180.0;
  }
  /// The greatest values are codes (SICK, list of telegrams of the LMS 2xx): "greater than can be
  /// said" and "too little light comes back" both become "nothing seen".
  std::uint32_t wordOf(float metres) const override {
    const auto value =
        static_cast<std::uint32_t>(std::lround(metres * (isMillimetres_ ? 1000.0F : 100.0F)));
    const std::uint32_t special = isMillimetres_ ? 0x6000U : 0U;
    if (value == special + 0x1FF7U || value == special + 0x1FFBU) return kNothing;
    if (value >= special + 0x1FF7U) return 0;
    return isMillimetres_ ? value : 10 * value;
  }

 private:
  mrpt::hwdrivers::CSickLaserSerial sick_;
  int view_;
  int resolution_;
  bool isMillimetres_;
};

/// Gives access to what the scanner says about its beams, which the driver does not publish.
class HokuyoDriver : public mrpt::hwdrivers::CHokuyoURG {
 public:
  const TSensorInfo& info() const { return m_sensor_info; }
};

class Hokuyo : public Scanner {
 public:
  explicit Hokuyo(const std::string& port) {
    if (!port.starts_with("tcp:")) {
      hokuyo_.setSerialPort(port);
      return;
    }
    const std::size_t colon = port.rfind(':');
    hokuyo_.setIPandPort(port.substr(4, colon - 4),
                         static_cast<unsigned>(numberOf(port.substr(colon + 1))));
  }
  mrpt::hwdrivers::C2DRangeFinderAbstract& driver() override { return hokuyo_; }
  bool start() override { return hokuyo_.turnOn(); }
  bool hasClock() const override { return true; }
  double angleStep(std::size_t) const override {
    if (hokuyo_.info().scans_per_360deg <= 0)
      throw std::runtime_error("the scanner does not say how many steps a turn has");
    return 2.0 * std::numbers::pi / hokuyo_.info().scans_per_360deg;
  }
  double firstAngle(std::size_t beams) const override {
    return (hokuyo_.info().scan_first - hokuyo_.info().scan_front) * angleStep(beams);
  }
  /// Values below 20 are codes of errors; 0 and 16 mean that no object is near.
  std::uint32_t wordOf(float metres) const override {
    const auto value = static_cast<std::uint32_t>(std::lround(metres * 1000.0F));
    if (value == 0 || value == 16 || value > 1000.0 * hokuyo_.info().d_max) return kNothing;
    return value < 20 ? 0 : value;
  }

 private:
  HokuyoDriver hokuyo_;
};

Message messageOf(const CObservation2DRangeScan& scan, const Scanner& scanner) {
  const std::size_t beams = scan.getScanSize();
  Message message;
  message.id = {"mrpt", "device", "scan"};
  message.stamp =
      std::chrono::duration_cast<std::chrono::microseconds>(scan.timestamp.time_since_epoch())
          .count();
  constexpr double kFine = 1e8;
  message.words = {
      static_cast<std::uint32_t>((1LL << 31) + std::llround(scanner.firstAngle(beams) * kFine)),
      static_cast<std::uint32_t>(std::llround(scanner.angleStep(beams) * kFine)),
      scanner.hasClock() ? 1U : 0U};
  for (std::size_t i = 0; i < beams; ++i)
    message.words.push_back(scanner.wordOf(scan.getScanRange(i)));
  return message;
}

void print(const std::string& line, std::FILE* out) {
  const bool isWritten = std::fputs(line.c_str(), out) >= 0 && std::fflush(out) == 0;
  if (!isWritten) throw std::runtime_error("the output was closed");
}

void readOn(Scanner& scanner, std::FILE* out) {
  if (!scanner.start()) throw std::runtime_error("does not answer like a scanner");
  print("# open\n", out);
  int silent = 0;
  std::string line;
  while (true) {
    CObservation2DRangeScan scan;
    bool isThere = false;
    bool isBroken = false;
    scanner.driver().doProcessSimple(isThere, scan, isBroken);
    if (isBroken) throw std::runtime_error("the connection is lost, or the data are invalid");
    if (isThere) {
      silent = 0;
      line.clear();
      writeLine(messageOf(scan, scanner), line);
      print(line + "\n", out);
    } else if (++silent > kSilentLooks) {
      throw std::runtime_error("sends no scans any more");
    } else {
      usleep(1000);
    }
  }
}

/// Returns the one line that matters of MRPT's message, which is a stack trace.
std::string oneLine(const std::string& text) {
  const std::string mark = "Message:";
  const std::size_t at = text.find(mark);
  const std::size_t begin =
      at == std::string::npos ? 0 : text.find_first_not_of(" \r\n", at + mark.size());
  if (begin == std::string::npos) return "unknown error";
  return text.substr(begin, text.find_first_of("\r\n", begin) - begin);
}

std::unique_ptr<Scanner> makeScanner(const std::vector<std::string>& words) {
  if (words.size() == 6 && words[0] == "sick")
    return std::make_unique<Sick>(words[1], numberOf(words[2]), numberOf(words[3]),
                                  numberOf(words[4]), words[5] == "mm");
  if (words.size() == 2 && words[0] == "hokuyo") return std::make_unique<Hokuyo>(words[1]);
  throw std::runtime_error(
      "usage: ortung-mrpt-device sick PORT BAUD VIEW RESOLUTION mm|cm, or "
      "hokuyo PORT");
}

int run(const std::vector<std::string>& words, std::FILE* out) {
  try {
    readOn(*makeScanner(words), out);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(out, "# error %s\n", oneLine(error.what()).c_str());
    std::fflush(out);
  }
  // Destructors of drivers send a last command, which can take long on a lost connection.
  std::_Exit(1);
}

}  // namespace
}  // namespace ortung

int main(int count, char** arguments) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // this process must not outlive its parent
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return ortung::run({arguments + 1, arguments + count}, ortung::ownOutput());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ortung-mrpt-device: %s\n", error.what());
    return 1;
  }
}
