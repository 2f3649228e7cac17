#include "Axis.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::app {

double roundLength(double length) {
  if (!(length > 0.0) || !std::isfinite(length)) return 1.0;
  const double ten = std::pow(10.0, std::floor(std::log10(length)));
  if (length >= 5.0 * ten) return 5.0 * ten;
  return length >= 2.0 * ten ? 2.0 * ten : ten;
}

std::vector<double> axisTicks(double low, double high, int most) {
  std::vector<double> ticks;
  if (!(high > low) || !std::isfinite(high - low)) return ticks;
  double step = roundLength((high - low) / std::max(most, 1));
  while ((high - low) / step + 1.0 > most && std::isfinite(step)) step = roundLength(2.501 * step);
  // Multiples are counted, so that 0.3 is not 0.30000000000000004 and zero is not -0.
  const double first = std::ceil(low / step - 1e-9);
  for (int i = 0; i < most; ++i) {
    const double multiple = first + i;
    if (multiple * step > high + 1e-9 * step) break;
    ticks.push_back(multiple == 0.0 ? 0.0 : multiple * step);
  }
  return ticks;
}

}  // namespace ortung::app
