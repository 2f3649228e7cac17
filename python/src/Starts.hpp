#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "Bindings.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::python {

/// Reads 'global', 'truth' or (x, y, theta). @throws py::value_error
LocalizationStart startOf(const py::object& start);

/// What evaluate() and Localization have in common: what is localized, by what, and from where.
LocalizationConfig configOf(const std::filesystem::path& robot, const std::filesystem::path& tables,
                            const std::string& source, std::uint64_t seed,
                            std::optional<std::size_t> particles, std::optional<unsigned> threads,
                            const py::object& start);

}  // namespace ortung::python
