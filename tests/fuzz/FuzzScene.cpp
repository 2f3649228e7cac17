// A scene file, beside a world and robot files that it may name.
#include "Fuzz.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/sim/Scene.hpp"

namespace {

using namespace ortung;

bool writeFiles() {
  fuzz::write("world.toml", "[[ellipse]]\nkind = \"post\"\ncenter_m = [0, 0]\nsize_m = [1, 1]\n");
  fuzz::write("robot.toml", "[robot]\nname = \"r\"\n");
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const bool kIsReady = writeFiles();
  fuzz::require(kIsReady);
  const auto file = fuzz::write("scene.toml", {reinterpret_cast<const char*>(bytes), size});
  fuzz::refusedOrDone<ConfigError>([&] {
    if (!Scene::isScene(file)) return;
    const Scene scene = Scene::read(file);
    fuzz::require(!scene.robots.empty());
    for (std::size_t i = 1; i < scene.commands.size(); ++i)
      fuzz::require(scene.commands[i - 1].at <= scene.commands[i].at);
  });
  return 0;
}
