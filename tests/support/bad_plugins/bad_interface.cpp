#include "ortung/core/Plugin.hpp"

static constexpr ortung::PluginEntry kEntries[] = {
    {"ortung.SensorData/0.0.1-00000000", "yesterday",
     [](const ortung::Parameters&) -> void* { return nullptr; }}};
extern "C" ORTUNG_API constinit const ortung::PluginInfo ortungPlugins = {
    ortung::kPluginAbi,
    sizeof(ortung::PluginInfo),
    ortung::kBuildTag,
    "bad_interface",
    "0.0.1",
    kEntries,
    1};
