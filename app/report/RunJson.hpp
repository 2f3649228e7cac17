#pragma once

#include <nlohmann/json.hpp>

#include "RunResult.hpp"

// nlohmann/json takes long to compile: for sources of figures alone.
namespace ortung::app {

/// JSON has no NaN and no infinity.
nlohmann::ordered_json jsonNumber(double value);

/// One run, as docs/mcl.md tells.
nlohmann::ordered_json jsonOf(const RunResult& run);

/// File names need not be UTF-8; whoever reads the JSON may rely on it.
std::string jsonText(const nlohmann::ordered_json& json);

}  // namespace ortung::app
