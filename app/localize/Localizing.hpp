#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "LocalizationArguments.hpp"
#include "Outputs.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/study/Evaluation.hpp"

namespace ortung::app {

/// Opens the source of the command line and MCL on it. Warns if the source comes from another world
/// than the tables, which --any-world allows.
/// @param warns whether to print warnings about source and tables on stderr
/// @param makeSource opens the source; empty: the source of the command line
/// @throws UsageError; else as ortung::Localization
std::unique_ptr<Localization> openLocalization(
    const LocalizationArguments& arguments, bool warns = true,
    const std::function<std::unique_ptr<Source>(Robot&)>& makeSource = {});

/// Declares the files that every run of MCL reads.
void declareInputs(const LocalizationArguments& arguments, Outputs& outputs);

/// Returns the next update of the belief, or nothing at the end of the source; a signal is the end
/// of a live source, too.
/// @param onMoment called for the readings of every time, before MCL gets them
/// @throws Interrupted, std::runtime_error
std::optional<EvaluationStep> nextStep(Localization& localization,
                                       const LocalizationArguments& arguments,
                                       const std::function<void(const Feeder&)>& onMoment = {});

/// Fails if a run had no update. @throws std::runtime_error saying what was missing
void requireUpdates(std::size_t updates, const LocalizationArguments& arguments);

/// Warns how MCL predicts motion without odometry, if there was none; returns whether it did.
bool warnWithoutOdometry(const Localization& localization, const LocalizationArguments& arguments);

}  // namespace ortung::app
