#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
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

/// The localization of a configuration. A mismatch is told by the name that the argument has here.
/// @throws WorldMismatch if the readings are of another world than the tables and that was not
///   permitted, and what Localization does
std::unique_ptr<Localization> localizationOf(LocalizationConfig config, bool anyWorld);

}  // namespace ortung::python
