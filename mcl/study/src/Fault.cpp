#include "ortung/study/Fault.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "Disturbance.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/run/Feeder.hpp"

namespace ortung {
namespace {

using Kind = Fault::Kind;

struct Form {
  std::string_view name;
  Kind kind;
  FaultOf of;
  std::string_view value;  ///< example of a value; "": the fault takes none
  double low;
  double high;
  std::string_view help;
};

constexpr double kAny = 1e4;
constexpr std::array<Form, 14> kForms = {{
    {"missing", Kind::kMissing, FaultOf::kReading, "", 0, 0, "nothing comes"},
    {"frozen", Kind::kFrozen, FaultOf::kReading, "", 0, 0,
     "the first reading is repeated, with new stamps"},
    {"drop", Kind::kDrop, FaultOf::kReading, "SHARE", 0, 1, "that share of the readings is lost"},
    {"late", Kind::kLate, FaultOf::kReading, "SECONDS", 0, 3600, "stamps are later"},
    {"none", Kind::kMissing, FaultOf::kOdometry, "", 0, 0, "nothing comes"},
    {"zero", Kind::kFrozen, FaultOf::kOdometry, "", 0, 0, "pose and velocities stay as they were"},
    {"scale", Kind::kScale, FaultOf::kOdometry, "FACTOR", 0, 100, "the way is so much too long"},
    {"turn", Kind::kTurns, FaultOf::kOdometry, "FACTOR", 0, 100, "turns are so much too large"},
    {"reverse", Kind::kReverse, FaultOf::kOdometry, "", 0, 0, "the way has the wrong sign"},
    {"slip", Kind::kSlip, FaultOf::kOdometry, "", 0, 0,
     "the robot moves, odometry stands, and goes on from there"},
    {"jump", Kind::kJump, FaultOf::kOdometry, "X,Y,DEG", -kAny, kAny,
     "the pose jumps once, at FROM: ahead, to the left [m], to the left [degrees]"},
    {"crowd", Kind::kCrowd, FaultOf::kScan, "", 0, 0,
     "people 0.4 to 1.5 m away hide more than half of the beams"},
    {"random", Kind::kRandom, FaultOf::kScan, "SHARE", 0, 1,
     "that share of the beams, or of whatever a reading lists, is random"},
    {"short", Kind::kShort, FaultOf::kScan, "SHARE", 0, 1,
     "that share of the beams, or of what a plugin's format lists, reads too little"},
}};

std::string_view nameOf(FaultOf of) {
  if (of == FaultOf::kOdometry) return "odometry";
  return of == FaultOf::kScan ? "scans, and what lists several things" : "all readings";
}

/// Returns the name of @p form, with its value, as users write it.
std::string written(const Form& form) {
  const std::string name(form.name);
  return form.value.empty() ? name : name + ":" + std::string(form.value);
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw FaultError("fault '" + text + "': " + why);
}

const Form& formOf(const std::string& text, const std::string& name) {
  std::string known;
  for (const Form& form : kForms) {
    if (form.name == name) return form;
    known += (known.empty() ? "" : ", ") + written(form);
  }
  refuse(text, "there is no fault '" + name + "', expected one of " + known);
}

void readValues(Fault& fault, const Form& form, const std::string& value, bool isGiven) {
  const std::string expected = "expected " + written(form);
  if (form.value.empty()) {
    if (isGiven) refuse(fault.text, expected + ", which takes no value");
    return;
  }
  const auto numbers = parseNumbers(value);
  const std::size_t wanted = form.kind == Kind::kJump ? 3 : 1;
  if (!numbers || numbers->size() != wanted) refuse(fault.text, expected);
  for (const double n : *numbers) {
    if (n >= form.low && n <= form.high) continue;
    refuse(fault.text, expected + " with " + (wanted == 1 ? "a number" : "numbers") + " from " +
                           number(form.low) + " to " + number(form.high));
  }
  fault.values = *numbers;
  if (form.kind == Kind::kJump) fault.values[2] = wrapAngle(radians(fault.values[2]));
}

void readTime(Fault& fault, const std::string& time) {
  constexpr double kLongest = 1e9;
  const auto numbers = parseNumbers(time, '-');
  const bool isRead = numbers && (numbers->size() == 1 || numbers->size() == 2);
  const double from = isRead ? numbers->front() : -1.0;
  const double to = isRead && numbers->size() == 2 ? numbers->back() : fault.to;
  if (!(from >= 0.0 && from <= kLongest && to > from))
    refuse(fault.text, "its time is '" + time +
                           "', expected FROM-TO or FROM in seconds since the first reading, "
                           "0 <= FROM < TO");
  fault.from = from;
  fault.to = to;
}

void checkWhat(const Fault& fault) {
  if (fault.what == "odometry" || fault.what == "readings") return;
  const std::string expected =
      "expected odometry, readings or a feature's name model/type/feature before '='";
  try {
    if (parseSensorId(fault.what).type != kGroundTruth) return;
  } catch (const std::invalid_argument&) {
    refuse(fault.text, expected + ", found '" + fault.what + "'");
  }
  refuse(fault.text, "ground truth is never altered; " + expected);
}

}  // namespace

FaultError::~FaultError() = default;
Disturbance::~Disturbance() = default;

FaultOf groupOf(Kind kind) {
  for (const Form& form : kForms)
    if (form.kind == kind) return form.of;
  return FaultOf::kReading;
}

Fault parseFault(const std::string& text) {
  Fault fault;
  fault.text = text;
  const std::size_t equals = text.find('=');
  if (equals == text.npos) refuse(text, "expected WHAT=FAULT[:VALUE][@FROM-TO]");
  fault.what = text.substr(0, equals);
  checkWhat(fault);
  std::string name = text.substr(equals + 1);
  if (const std::size_t at = name.find('@'); at != name.npos) {
    readTime(fault, name.substr(at + 1));
    name.resize(at);
  }
  const std::size_t colon = name.find(':');
  const Form& form = formOf(text, name.substr(0, colon));
  fault.kind = form.kind;
  readValues(fault, form, colon == name.npos ? "" : name.substr(colon + 1), colon != name.npos);
  if (form.of == FaultOf::kOdometry && fault.what == "readings")
    refuse(text,
           std::string(form.name) + " is a fault of odometry, expected odometry=" + written(form));
  if (form.of == FaultOf::kScan && fault.what == "odometry")
    refuse(text,
           std::string(form.name) + " is a fault of scans, expected readings=" + written(form));
  return fault;
}

std::string faultHelp() {
  std::string text;
  for (const FaultOf of : {FaultOf::kReading, FaultOf::kOdometry, FaultOf::kScan}) {
    text += "  " + std::string(nameOf(of)) + ":\n";
    for (const Form& form : kForms) {
      if (form.of != of) continue;
      std::string left = "    " + written(form);
      left.resize(20, ' ');
      text += left + std::string(form.help) + "\n";
    }
  }
  return text;
}

}  // namespace ortung
