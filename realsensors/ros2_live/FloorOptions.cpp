#include "FloorOptions.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>

#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/MapFiles.hpp"

namespace ortung::ros2 {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& expected) {
  throw std::invalid_argument(option + " is " + inQuotes(text) + ", expected " + expected);
}

/// Returns the name before the first '=', as world files have names of floors and lifts.
std::string nameOf(const std::string& option, const std::string& text,
                   const std::string& expected) {
  constexpr std::size_t kLongest = 64;
  const std::string name = text.substr(0, text.find('='));
  const auto isPlain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (name.empty() || name.size() == text.size() || name.size() > kLongest ||
      !std::all_of(name.begin(), name.end(), isPlain))
    refuse(option, text, expected + ", where NAME is of [A-Za-z0-9_-]{1,64}");
  return name;
}

std::string floorToml(const std::string& text) {
  const std::string expected = "NAME=MAP, as ground=ground.yaml";
  const std::string name = nameOf("--floor", text, expected);
  const std::string map = text.substr(name.size() + 1);
  if (map.empty()) refuse("--floor", text, expected);
  return "\n[[floor]]\nname = " + tomlText(name) + "\n" +
         gridKeys(std::filesystem::absolute(map).lexically_normal().string());
}

std::string liftToml(const std::string& text) {
  constexpr double kFarthest = 1e4;  // [m]
  const std::string expected = "NAME=X,Y or NAME=X,Y,RADIUS [m], as east=12.5,3.0";
  const std::string name = nameOf("--lift", text, expected);
  std::istringstream in(text.substr(name.size() + 1));
  double x = 0.0;
  double y = 0.0;
  double radius = 1.0;
  char comma = 0;
  if (!(in >> x >> comma >> y) || comma != ',') refuse("--lift", text, expected);
  if (!in.eof() && (!(in >> comma >> radius) || comma != ',' || !in.eof()))
    refuse("--lift", text, expected);
  if (!(std::abs(x) <= kFarthest && std::abs(y) <= kFarthest && radius >= 0.1 && radius <= 20.0))
    refuse("--lift", text, expected + ", within 10 km, with a radius of 0.1 to 20 m");
  return "\n[[lift]]\nname = " + tomlText(name) + "\nposition_m = [" + tomlNumber(x) + ", " +
         tomlNumber(y) + "]\nradius_m = " + tomlNumber(radius) + "\n";
}

}  // namespace

std::string buildingToml(const std::vector<std::string>& floors,
                         const std::vector<std::string>& lifts) {
  std::string toml = "[world]\nname = \"building\"\n";
  std::set<std::string> names;
  for (const std::string& floor : floors) {
    toml += floorToml(floor);
    if (!names.insert(floor.substr(0, floor.find('='))).second)
      refuse("--floor", floor, "another name for each floor");
  }
  for (const std::string& lift : lifts) toml += liftToml(lift);
  return toml;
}

}  // namespace ortung::ros2
