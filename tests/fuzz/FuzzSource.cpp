// Texts that name a source or a feature, and lists of numbers: what the command line takes. A text
// of the simulator opens it in a small world.
#include <cmath>

#include "Fuzz.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/sim/Simulation.hpp"

namespace {

using namespace ortung;

bool writeFiles() {
  fuzz::write("world.toml",
              "[world]\nx_m = [-3, 3]\ny_m = [-2, 2]\n[[ellipse]]\nkind = \"post\"\n"
              "center_m = [0, 0]\nsize_m = [0.5, 0.5]\n");
  fuzz::write("robot.toml",
              "[robot]\nname = \"r\"\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n");
  return true;
}

void parse(const std::string& text) {
  for (const char separator : {',', ';', ' '})
    if (const auto numbers = parseNumbers(text, separator))
      for (const double number : *numbers) fuzz::require(std::isfinite(number));
  fuzz::refusedOrDone<std::invalid_argument>([&] { parseSensorQuery(text); });
  fuzz::refusedOrDone<std::invalid_argument>(
      [&] { fuzz::require(toText(parseSensorId(text)) == text); });
}

void parseOptions(const SourceText& parsed) {
  Parameters options("options");
  for (const auto& [key, value] : parsed.options) options.set(key, value);
  for (const auto& option : parsed.options) {
    const std::string& key = option.first;
    fuzz::refusedOrDone<ConfigError>([&] {
      const auto number = optionNumber(options, key, {-10.0, 10.0});
      fuzz::require(number && *number >= -10.0 && *number <= 10.0);
    });
    fuzz::refusedOrDone<ConfigError>([&] {
      const auto pose = optionPose(options, key);
      fuzz::require(pose && isFinite(*pose) && std::abs(pose->theta) <= kTurn);
    });
  }
}

void openSimulator(const SourceText& parsed) {
  static PluginFactory factory({ORTUNG_PLUGINS_DIR});
  Parameters parameters("sim");
  for (const auto& [key, value] : parsed.options) parameters.set(key, value);
  parameters.set("path", "world.toml");
  parameters.set("robot_file", "robot.toml");
  const auto source = factory.make<Source>("sim", parameters);
  Message message;
  for (int i = 0; i < 5 && source->next(message); ++i) fuzz::require(!message.id.model.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const bool kIsReady = writeFiles();
  fuzz::require(kIsReady);
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  parse(text);
  fuzz::refusedOrDone<std::runtime_error, std::invalid_argument>([&] {
    const SourceText parsed = parseSourceText(text);
    parseOptions(parsed);
    if (parsed.kind == "sim") openSimulator(parsed);
  });
  return 0;
}
