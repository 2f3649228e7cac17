#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "Commands.hpp"
#include "EstimatesText.hpp"
#include "Localization.hpp"
#include "OutputFile.hpp"
#include "Progress.hpp"

namespace ortung::app {

int runLocalize(const LocalizeArguments& arguments) {
  const bool toFile = !arguments.out.empty();
  if (toFile) checkOutput(arguments.out);
  Localization localization(arguments.localization);
  std::string text(kEstimatesHeader);
  std::size_t updates = 0;
  {
    Progress progress("localizing", arguments.localization.progress);
    while (const std::optional<EvaluationStep> step = localization.next()) {
      ++updates;
      appendEstimate(step->estimate, text);
      if (toFile) {
        progress.update(localization.feeder().progress());
        continue;
      }
      // Whoever reads our output gets each pose as soon as it is known.
      fmt::print("{}", text);
      std::fflush(stdout);
      text.clear();
    }
  }
  localization.feeder().warnOfUnknown();
  if (updates == 0) {
    throw std::runtime_error(arguments.localization.source +
                             ": gave no reading of any feature that the tables know, so there is "
                             "nothing to localize with");
  }
  if (toFile) writeFile(arguments.out, text);
  return 0;
}

}  // namespace ortung::app
