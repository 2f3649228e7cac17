#include "ortung/vision/Verdict.hpp"

#include <algorithm>

namespace ortung {

bool Verdict::isDetermined() const {
  return !checks.empty() &&
         std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.isMet(); });
}

std::string Verdict::sentence() const {
  if (isDetermined()) return "determined";
  std::vector<std::string> advices;
  for (const Check& check : checks)
    if (!check.isMet() && !check.advice.empty() &&
        std::find(advices.begin(), advices.end(), check.advice) == advices.end())
      advices.push_back(check.advice);
  std::string text = "not determined";
  for (const std::string& advice : advices)
    text += (&advice == advices.data() ? ": take " : "; ") + advice;
  return text;
}

}  // namespace ortung
