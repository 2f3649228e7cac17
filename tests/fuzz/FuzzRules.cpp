// A rules file of the soccer referee, which may have another one as its base.
#include "Fuzz.hpp"
#include "Rules.hpp"

namespace {

using namespace ortung;

bool writeFiles() {
  fuzz::write("base.toml", "[match]\nhalves = 3\n[areas]\nown_goal_area = 1\n");
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const bool kIsReady = writeFiles();
  fuzz::require(kIsReady);
  const auto file = fuzz::write("rules.toml", {reinterpret_cast<const char*>(bytes), size});
  fuzz::refusedOrDone<ConfigError>([&] {
    const soccer::Rules rules = soccer::readRules(file);
    fuzz::require(rules.match.halves >= 1 && rules.match.half >= 1.0);
    fuzz::require(rules.restart.setPiece >= 0.0 && rules.stuck.radius > 0.0);
    for (const auto& places : {rules.kickOff.own, rules.kickOff.other})
      for (const FloorPoint& place : places) fuzz::require(place.x >= -1.0 && place.x <= 0.0);
  });
  return 0;
}
