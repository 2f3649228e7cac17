#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "LocalizationArguments.hpp"
#include "Outputs.hpp"
#include "ortung/study/Evaluation.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::app {

/// What eval and localize do alike: MCL on a source as the command line says. Warns where the
/// source comes from another world than the tables and --any-world lets it pass.
/// @param warns says what is odd about source and tables, on stderr
/// @param makeSource opens the source; without, it is what the command line names
/// @throws UsageError; else as ortung::Localization
std::unique_ptr<Localization> openLocalization(
    const LocalizationArguments& arguments, bool warns = true,
    const std::function<std::unique_ptr<Source>(Robot&)>& makeSource = {});

/// What every run of MCL reads.
void declareInputs(const LocalizationArguments& arguments, Outputs& outputs);

/// The next update of the belief, or nothing at the end of the source: a live one ends with a
/// signal, too.
/// @param onMoment called for every moment of the source, before it is looked at by MCL
/// @throws Interrupted, std::runtime_error
std::optional<EvaluationStep> nextStep(Localization& localization,
                                       const LocalizationArguments& arguments,
                                       const std::function<void(const Feeder&)>& onMoment = {});

/// @throws std::runtime_error saying what was missing, if a run had no update
void requireUpdates(std::size_t updates, const LocalizationArguments& arguments);

/// Says what MCL does without odometry, if none has come; returns whether it said so.
bool warnWithoutOdometry(const Localization& localization, const LocalizationArguments& arguments);

}  // namespace ortung::app
