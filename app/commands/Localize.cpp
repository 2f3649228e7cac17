#include <fmt/format.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "Commands.hpp"
#include "EstimatesText.hpp"
#include "Localizing.hpp"
#include "OutputFile.hpp"
#include "Progress.hpp"
#include "SourceArguments.hpp"

namespace ortung::app {

int runLocalize(const LocalizeArguments& arguments) {
  const bool toFile = !arguments.out.empty();
  if (toFile) checkOutput(arguments.out);
  const LocalizationArguments& run = arguments.localization;
  const std::unique_ptr<Localization> localization = openLocalization(run);
  std::string text(kEstimatesHeader);
  constexpr double kPatience = 5.0;  // for the first odometry of a live source [s]
  std::size_t updates = 0;
  bool warned = false;
  {
    Progress progress("localizing", run.progress);
    while (const std::optional<EvaluationStep> step = nextStep(*localization, run)) {
      ++updates;
      if (!warned && localization->feeder().seconds() > kPatience)
        warned = warnWithoutOdometry(*localization, run);
      appendEstimate(step->estimate, text);
      if (toFile) {
        progress.update(localization->feeder().progress());
        continue;
      }
      // Whoever reads our output gets each pose as soon as it is known.
      fmt::print("{}", text);
      std::fflush(stdout);
      text.clear();
    }
  }
  warnOfUnknown(run.source, localization->feeder());
  if (updates == 0) {
    throw std::runtime_error(run.source +
                             ": gave no reading that says anything about a pose, of a feature that "
                             "was learned, so there is "
                             "nothing to localize with");
  }
  if (!warned) warnWithoutOdometry(*localization, run);
  if (toFile) writeFile(arguments.out, text);
  return 0;
}

}  // namespace ortung::app
