#pragma once

#include <map>
#include <string>

namespace ortung::bench {

/// What a program has measured that is no Google Benchmark, for scripts/performance.py.
class Figures {
 public:
  /// Writes them into the file $ORTUNG_FIGURES, if it is set, as Google Benchmark would.
  void write() const;
  void put(const std::string& name, const std::string& counter, double value) {
    figures_[name][counter] = value;
  }

 private:
  std::map<std::string, std::map<std::string, double>> figures_;
};

}  // namespace ortung::bench
