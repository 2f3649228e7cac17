#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

#include "Commands.hpp"
#include "Localization.hpp"
#include "OutputFile.hpp"
#include "Progress.hpp"

namespace ortung::app {
namespace {

constexpr const char* kHeader =
    "# stamp_us x_m y_m theta_rad cov_xx_m2 cov_xy_m2 cov_xtheta_m_rad cov_yy_m2 cov_ytheta_m_rad "
    "cov_thetatheta_rad2 share samples\n";

void appendLine(const PoseEstimate& estimate, std::string& text) {
  const auto& c = estimate.covariance;
  fmt::format_to(std::back_inserter(text),
                 "{} {:.4f} {:.4f} {:.5f} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.3f} {}\n",
                 estimate.stamp, estimate.pose.x, estimate.pose.y, estimate.pose.theta, c[0], c[1],
                 c[2], c[4], c[5], c[8], estimate.share, estimate.samples);
}

}  // namespace

int runLocalize(const LocalizeArguments& arguments) {
  const bool toFile = !arguments.out.empty();
  if (toFile) checkOutput(arguments.out);
  Localization localization(arguments.localization);
  std::string text = kHeader;
  std::size_t updates = 0;
  {
    Progress progress("localizing", arguments.localization.progress);
    while (const std::optional<EvaluationStep> step = localization.next()) {
      ++updates;
      appendLine(step->estimate, text);
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
