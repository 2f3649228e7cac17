#pragma once

#include <nlohmann/json_fwd.hpp>

#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// What a table file says of the field. Numbers in metres and radians, in lists.
nlohmann::json toJson(const FieldModel& field);
/// @throws std::exception saying what is missing, of the wrong kind or out of range
FieldModel fieldModelOf(const nlohmann::json& json);

}  // namespace ortung
