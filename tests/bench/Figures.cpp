#include "Figures.hpp"

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace ortung::bench {

void Figures::write() const {
  const char* file = std::getenv("ORTUNG_FIGURES");
  if (file == nullptr) return;
  nlohmann::json all = nlohmann::json::array();
  for (const auto& [name, counters] : figures_) {
    nlohmann::json one = counters;
    one["name"] = name;
    all.push_back(std::move(one));
  }
  std::ofstream(file) << nlohmann::json{{"benchmarks", std::move(all)}}.dump(1) << '\n';
}

}  // namespace ortung::bench
