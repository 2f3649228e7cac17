#pragma once

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace ortung {

/// @return the value that the environment variable ORTUNG_CONSTANTS gives for @p name, e.g.
///   "lead.kEnoughNats=8 trust.kStationary=0.004", else @p value; integers are rounded
/// @throws std::invalid_argument if what is given is not a number
template <typename Number>
Number swept(const char* name, Number value) {
  const char* given = std::getenv("ORTUNG_CONSTANTS");
  std::istringstream words(given ? given : "");
  for (std::string word; words >> word;) {
    const std::size_t sign = word.find('=');
    if (sign == std::string::npos || word.substr(0, sign) != name) continue;
    const double number = std::stod(word.substr(sign + 1));
    if constexpr (std::is_integral_v<Number>) return static_cast<Number>(std::llround(number));
    return static_cast<Number>(number);
  }
  return value;
}

/// Adds a line to the file that ORTUNG_SIGNS names, if it does: what an estimate's quality is made
/// of, for scripts/fit-confidence.py.
inline void noteSigns(std::initializer_list<double> numbers) {
  static const char* file = std::getenv("ORTUNG_SIGNS");
  if (file == nullptr) return;
  static std::ofstream out(file);
  out.precision(17);
  for (const double number : numbers) out << number << ' ';
  out << '\n';
}

}  // namespace ortung
