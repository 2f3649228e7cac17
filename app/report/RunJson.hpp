#pragma once

#include <nlohmann/json.hpp>

#include "RunResult.hpp"

// nlohmann/json takes long to compile, so only sources of figures include this.
namespace ortung::app {

/// Returns a number, or null for NaN and infinity, which JSON does not have.
nlohmann::ordered_json jsonNumber(double value);

/// Returns a run as docs/mcl.md describes it.
nlohmann::ordered_json jsonOf(const RunResult& run);

/// Formats JSON as UTF-8; invalid bytes, e.g. in names of files, are replaced.
std::string jsonText(const nlohmann::ordered_json& json);

}  // namespace ortung::app
