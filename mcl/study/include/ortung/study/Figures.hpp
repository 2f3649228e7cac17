#pragma once

#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/study/Evaluation.hpp"

/// The figures of a run by the names that files and programs have for them (docs/mcl.md lists
/// them): names end in their unit, and a value that does not exist is NaN.
namespace ortung {

/// One figure.
struct NamedFigure {
  const char* name = "";
  double value = 0.0;
  bool isCount = false;  ///< whether it is a whole number
};
using NamedFigures = std::vector<NamedFigure>;

/// Returns what was compared, and the errors over time.
ORTUNG_API NamedFigures errorFigures(const EvaluationResult& run);
/// Returns the computing times of updates; they differ from run to run.
ORTUNG_API NamedFigures timeFigures(const EvaluationResult& run);
/// Returns whether covariances are as large as errors.
ORTUNG_API NamedFigures consistencyFigures(const EvaluationResult& run);
/// Returns the errors at the times of updates only.
ORTUNG_API NamedFigures correctionFigures(const EvaluationResult& run);
/// Returns what the protection levels are worth.
ORTUNG_API NamedFigures protectionFigures(const EvaluationResult& run);

}  // namespace ortung
