#include "ortung/core/Plugin.hpp"

extern "C" ORTUNG_API constinit const ortung::PluginInfo ortungPlugins = {
    ortung::kPluginAbi,
    sizeof(ortung::PluginInfo),
    "container 0.0.1, gcc4-cxx11abi0",
    "bad_tag",
    "0",
    nullptr,
    0};
