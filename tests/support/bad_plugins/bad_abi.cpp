#include "ortung/core/Plugin.hpp"

extern "C" ORTUNG_API constinit const ortung::PluginInfo ortungPlugins = {
    99, sizeof(ortung::PluginInfo), ortung::kBuildTag, "bad_abi", "0", nullptr, 0};
