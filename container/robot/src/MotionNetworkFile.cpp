#include "ortung/robot/MotionNetworkFile.hpp"

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ortung/base/InputFile.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "ortung motion network 1";
constexpr std::size_t kMostBytes = 4U << 20;
constexpr int kDeepest = 8;

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw ConfigError(name + ": " + what);
}

const json& need(const json& object, const char* key, const std::string& name) {
  const auto found = object.find(key);
  if (found == object.end()) refuse(name, std::string("found no '") + key + "', expected one");
  return *found;
}

double number(const json& object, const char* key, const std::string& name) {
  const json& value = need(object, key, name);
  if (!value.is_number()) refuse(name, std::string("'") + key + "' is no number, expected one");
  return value.get<double>();
}

std::size_t count(const json& object, const char* key, const std::string& name) {
  const double value = number(object, key, name);
  if (!(value >= 0.0 && value <= 4096.0) || value != static_cast<double>(static_cast<int>(value))) {
    refuse(name, std::string("'") + key + "' is " + std::to_string(value) +
                     ", expected a whole number from 0 to 4096");
  }
  return static_cast<std::size_t>(value);
}

std::vector<double> numbers(const json& object, const char* key, const std::string& name) {
  const json& list = need(object, key, name);
  if (!list.is_array()) refuse(name, std::string("'") + key + "' is no list, expected numbers");
  std::vector<double> out;
  for (const json& value : list) {
    if (!value.is_number()) {
      refuse(name, std::string("'") + key + "' holds " + value.type_name() + ", expected numbers");
    }
    out.push_back(value.get<double>());
  }
  return out;
}

json parse(std::string_view text, const std::string& name) {
  try {
    return json::parse(text, [&](int depth, json::parse_event_t, json&) {
      if (depth > kDeepest) refuse(name, "is nested deeper than " + std::to_string(kDeepest));
      return true;
    });
  } catch (const json::exception& error) {
    refuse(name, std::string("is no JSON: ") + error.what());
  }
}

}  // namespace

MotionNetwork parseMotionNetwork(std::string_view text, const std::string& name) {
  if (text.size() > kMostBytes) refuse(name, "is larger than 4 MiB, expected a motion network");
  const json file = parse(text, name);
  if (!file.is_object() || !file.contains("format") || file["format"] != kFormat) {
    refuse(name,
           std::string("found no \"format\": \"") + kFormat + "\", expected a motion network");
  }
  MotionNetwork network;
  network.step = number(file, "step_s", name);
  network.commands = count(file, "commands", name);
  const json& from = need(file, "commands_from", name);
  if (from != "velocities" && from != "motion_data") {
    refuse(name,
           "'commands_from' is " + from.dump() + ", expected \"velocities\" or \"motion_data\"");
  }
  network.fromVelocities = from == "velocities";
  network.limit = {number(file, "limit_m_s", name), number(file, "limit_rad_s", name)};
  network.inputMean = numbers(file, "input_mean", name);
  network.inputScale = numbers(file, "input_scale", name);
  network.outputScale = numbers(file, "output_scale", name);
  const json& layers = need(file, "layers", name);
  if (!layers.is_array()) refuse(name, "'layers' is no list, expected the network's layers");
  for (const json& entry : layers) {
    const std::string place = name + ": layer " + std::to_string(network.layers.size());
    if (!entry.is_object())
      refuse(place, "is no object, expected inputs, outputs, weights and bias");
    network.layers.push_back({count(entry, "inputs", place), count(entry, "outputs", place),
                              numbers(entry, "weights", place), numbers(entry, "bias", place)});
  }
  try {
    network.check();
  } catch (const std::invalid_argument& error) {
    refuse(name, error.what());
  }
  return network;
}

MotionNetwork readMotionNetwork(const std::filesystem::path& file) {
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) refuse(file.string(), why + "; expected a motion network");
  std::string text(kMostBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) refuse(file.string(), cantBeRead(errno) + "; expected a motion network");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parseMotionNetwork(text, file.string());
}

std::string toJson(const MotionNetwork& network) {
  json file = {{"format", kFormat},
               {"step_s", network.step},
               {"commands", network.commands},
               {"commands_from", network.fromVelocities ? "velocities" : "motion_data"},
               {"limit_m_s", network.limit.translational},
               {"limit_rad_s", network.limit.rotational},
               {"input_mean", network.inputMean},
               {"input_scale", network.inputScale},
               {"output_scale", network.outputScale},
               {"layers", json::array()}};
  for (const MotionNetwork::Layer& layer : network.layers) {
    file["layers"].push_back({{"inputs", layer.inputs},
                              {"outputs", layer.outputs},
                              {"weights", layer.weights},
                              {"bias", layer.bias}});
  }
  return file.dump(1) + "\n";
}

}  // namespace ortung
