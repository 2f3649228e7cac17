// What others on the network ask of a node of ROS 2, and the files and words with which it starts.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "AmclParameters.hpp"
#include "Bond.hpp"
#include "Files.hpp"
#include "FloorOptions.hpp"
#include "Lifecycle.hpp"
#include "LiveMaps.hpp"
#include "LiveRequests.hpp"
#include "NodeMessages.hpp"
#include "ParameterServices.hpp"
#include "ParamsFile.hpp"
#include "RosArguments.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace {

using namespace ortung::ros2;

/// Whatever was set, the parameters are within their ranges.
void check(const AmclParameters& parameters) {
  for (const auto& one : AmclParameters::all())
    AmclParameters::check(std::string(one.name), parameters.get(one.name));
  if (parameters.settings().transformTolerance > 10.0) std::abort();
}

void askForParameters(std::uint8_t which, std::string_view bytes) {
  AmclParameters parameters;
  ParameterServices services(parameters, "/amcl", [](const AmclSettings&) {});
  const auto answer = [&] {
    switch (which % 6) {
      case 0:
        return services.get(bytes);
      case 1:
        return services.types(bytes);
      case 2:
        return services.describe(bytes);
      case 3:
        return services.list(bytes);
      case 4:
        return services.set(bytes);
      default:
        return services.setAtomically(bytes);
    }
  };
  try {
    if (answer().size() < 4) std::abort();
  } catch (const std::invalid_argument&) {  // it is no such request
    return;
  }
  check(parameters);
}

void readParameters(std::string_view text) {
  static const ortung::test::TemporaryFolder folder;
  const auto file = folder / "params.yaml";
  std::ofstream(file) << text;
  AmclParameters parameters;
  try {
    for (const auto& [name, value, isForAll] : readParamsFile(file, {"amcl", "/"}))
      parameters.setText(name, value);
  } catch (const std::runtime_error&) {  // it is no such file
  } catch (const std::invalid_argument&) {
  }
  check(parameters);
}

void readArguments(std::string_view text) {
  std::vector<std::string> words;
  std::istringstream in{std::string(text)};
  for (std::string word; in >> word;) words.push_back(word);
  try {
    const RosArguments all = RosArguments::read(words, "amcl");
    if (!all.names.resolve("scan").starts_with('/')) std::abort();
    AmclParameters parameters;
    for (const auto& one : all.parameters)
      if (one.file.empty()) parameters.setText(one.name, one.value);
  } catch (const std::invalid_argument&) {  // they are no such words
  }
}

/// Any map may be asked for; what is none is answered.
void askForMap(std::string_view bytes) {
  static const ortung::test::TemporaryFolder folder;
  LiveRequests requests("map");
  LiveMaps maps({"", {{"ground", folder / "ground.yaml"}}}, {"map", "map", folder.path()},
                requests);
  std::cerr.setstate(std::ios::failbit);  // which says why
  if (maps.load(bytes).size() < 4) std::abort();
}

void readFloors(std::string_view text) {
  const std::string word(text);
  for (const bool isLift : {false, true}) {
    try {
      const std::string toml =
          ortung::ros2::buildingToml({isLift ? "ground=ground.yaml" : word},
                                     isLift ? std::vector{word} : std::vector<std::string>());
      ortung::parseToml(toml, "building");
    } catch (const std::invalid_argument&) {  // it is no such word
    } catch (const ortung::ConfigError&) {    // it is no text
    }
  }
}

template <class Take>
void take(std::string_view bytes, Take taker) {
  try {
    taker(bytes);
  } catch (const std::invalid_argument&) {  // it is no such message
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (const std::uint8_t which = data[0]; which % 16) {
    case 0:
      take(bytes, [](std::string_view cdr) {
        LiveRequests requests("map");
        requests.takePose(cdr);
        if (!requests.take().pose) std::abort();
      });
      break;
    case 1:
      take(bytes, [](std::string_view cdr) {
        Bond bond("amcl", 0.1);
        bond.start();
        bond.hear(cdr);
      });
      break;
    case 2:
      take(bytes, [](std::string_view cdr) {
        LifecycleTransition wanted;
        readCdr(cdr, wanted);
        Lifecycle lifecycle(false);
        lifecycle.change(wanted.id, wanted.label);
      });
      break;
    case 3:
      readParameters(bytes);
      break;
    case 4:
      readArguments(bytes);
      break;
    case 5:
      take(bytes, askForMap);
      break;
    case 6:
      readFloors(bytes);
      break;
    default:
      askForParameters(which, bytes);
  }
  return 0;
}
