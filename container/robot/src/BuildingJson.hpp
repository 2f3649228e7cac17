#pragma once

#include <nlohmann/json_fwd.hpp>

#include "ortung/tables/Building.hpp"

namespace ortung {

/// What a table file says of floors and lifts. Numbers in metres and radians.
nlohmann::json toJson(const Building& building);
/// @throws std::exception saying what is missing, of the wrong kind or out of range
Building buildingOf(const nlohmann::json& json);

}  // namespace ortung
