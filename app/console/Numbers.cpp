#include "Numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "Console.hpp"
#include "ortung/core/SourceOptions.hpp"

namespace ortung::app {

std::vector<double> parseNumbers(const std::string& text, const std::string& option,
                                 const std::vector<std::string>& names) {
  auto numbers = ortung::parseNumbers(text);
  if (numbers && numbers->size() == names.size()) return std::move(*numbers);
  throw UsageError(fmt::format("{} is '{}', expected {} number{} \"{}\"", option, text,
                               names.size(), names.size() == 1 ? "" : "s", fmt::join(names, ",")));
}

}  // namespace ortung::app
