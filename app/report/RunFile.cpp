#include "RunFile.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ortung/base/InputFile.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Reads a JSON object; its errors say where the object is.
class Reader {
 public:
  Reader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) fail("found " + std::string(json.type_name()) + ", expected an object");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(where_ + ": " + what);
  }
  bool has(const char* key) const { return json_.contains(key); }
  const Json& at(const char* key) const {
    if (!has(key)) fail(fmt::format("has no key '{}', as `ortung eval --json` writes it", key));
    return json_.at(key);
  }
  std::string text(const char* key) const {
    if (!at(key).is_string()) wrong(key, "text");
    return at(key).get<std::string>();
  }
  std::uint64_t count(const char* key) const {
    if (!at(key).is_number_unsigned()) wrong(key, "a whole number");
    return at(key).get<std::uint64_t>();
  }
  bool truth(const char* key) const {
    if (!at(key).is_boolean()) wrong(key, "true or false");
    return at(key).get<bool>();
  }
  /// Reads a number; NaN for null.
  double number(const char* key) const {
    if (at(key).is_null()) return kNan;
    if (!at(key).is_number()) wrong(key, "a number or null");
    return at(key).get<double>();
  }
  const Json& list(const char* key) const {
    if (!at(key).is_array()) wrong(key, "a list");
    return at(key);
  }
  const std::string& where() const { return where_; }

 private:
  [[noreturn]] void wrong(const char* key, const char* expected) const {
    fail(fmt::format("'{}' is {}, expected {}", key, at(key).type_name(), expected));
  }
  const Json& json_;
  std::string where_;
};

void readCase(const Reader& reader, FiledRun& run) {
  run.kind = reader.text("kind");
  run.number = reader.count("number");
  for (const Json& json : reader.list("events")) {
    const Reader event(json, fmt::format("{}, event {}", reader.where(), run.events.size() + 1));
    run.events.push_back(
        {event.truth("right"), event.number("after_s"), event.number("after_readings")});
  }
}

FiledRun readRun(const Json& json, const std::string& where) {
  const Reader reader(json, where);
  FiledRun run;
  run.source = reader.text("source");
  run.robot = reader.text("robot");
  run.seed = reader.count("seed");
  if (reader.has("start")) run.start = reader.text("start");
  if (reader.has("faults")) {
    for (const Json& fault : reader.list("faults")) {
      if (!fault.is_string()) reader.fail("a fault is not text");
      run.faults.push_back(fault.get<std::string>());
    }
  }
  if (reader.has("case")) readCase(Reader(reader.at("case"), where + ", case"), run);
  for (const auto& [key, value] : json.items())
    if (value.is_number() || value.is_null()) run.figures[key] = reader.number(key.c_str());
  for (const char* key : {"converged_after_s", "lost_share", "position_median_m"})
    run.figures[key] = reader.number(key);
  return run;
}

}  // namespace

std::string FiledRun::name() const {
  std::string text = source;
  if (kind != "whole") text += fmt::format(", {} {}", kind, number);
  if (kind == "whole" && !start.empty()) text += ", start " + start;
  for (const std::string& fault : faults) text += ", " + fault;
  return text + fmt::format(", seed {}, {}", seed, robot);
}

std::vector<FiledRun> readRuns(const std::filesystem::path& file) {
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) throw std::runtime_error(file.string() + ": " + why);
  const Json json = Json::parse(in, nullptr, false);
  if (json.is_discarded())
    throw std::runtime_error(file.string() +
                             ": is not JSON, expected what `ortung eval --json` "
                             "writes");
  const Reader whole(json, file.string());
  if (!whole.has("runs")) return {readRun(json, file.string())};
  std::vector<FiledRun> runs;
  for (const Json& run : whole.list("runs"))
    runs.push_back(readRun(run, fmt::format("{}: run {}", file.string(), runs.size() + 1)));
  return runs;
}

}  // namespace ortung::app
