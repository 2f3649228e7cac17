// A library that does ON_LOAD when it is loaded, before anybody has asked it for anything.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "ortung/core/Plugin.hpp"

namespace {

__attribute__((constructor)) void onLoad() { ON_LOAD; }

ortung::DeviceData make(const ortung::Parameters&) { return {}; }

}  // namespace

ORTUNG_PLUGINS("on_load", ortung::provideData<make>("on_load"));
