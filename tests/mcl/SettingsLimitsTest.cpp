// What [mcl] and MclConfig take, and what they refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "Files.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/mcl/MclConfig.hpp"

namespace ortung {
namespace {

std::string complaintAbout(const std::string& key, double value) {
  Parameters p("r.toml");
  p.set(key, value);
  return test::messageOf<ConfigError>([&] { MclConfig::read(p); });
}

TEST(MclSettingsLimits, KeysTakeTheirWholeRangeAndNothingBeyond) {
  struct Key {
    const char* name;
    double least;
    double most;
    double step;  ///< just beyond
  };
  for (const Key& key : std::vector<Key>{{"particles", 1, 5e6, 1},
                                         {"min_particles", 1, 20000, 1},
                                         {"resample_below", 0, 1, 1e-3},
                                         {"kld_error", 1e-4, 0.999, 1e-5},
                                         {"kld_quantile", 0.1, 9.9, 1e-3},
                                         {"bin_m", 1e-3, 100, 1e-4},
                                         {"bin_deg", 0.1, 360, 1e-3},
                                         {"start_candidates_per_m2", 1, 1e5, 1e-3},
                                         {"recover_fast", 0, 1, 1e-3},
                                         {"recover_slow", 0, 1, 1e-3},
                                         {"min_distance_m", 0, 100, 1e-3},
                                         {"min_rotation_deg", 0, 360, 1e-3},
                                         {"max_interval_s", 0, 1e6, 1e-3},
                                         {"drift_m", 0, 100, 1e-3},
                                         {"drift_deg", 0, 3600, 1e-3},
                                         {"budget_ms", 1, 1e6, 1e-3}}) {
    for (const double fine : {key.least, key.most})
      EXPECT_EQ(complaintAbout(key.name, fine), "(nothing was thrown)") << key.name << " " << fine;
    for (const double wrong : {key.least - key.step, key.most + key.step}) {
      const std::string text = complaintAbout(key.name, wrong);
      EXPECT_EQ(text.find(std::string("r.toml: ") + key.name + " is "), 0u) << text;
      EXPECT_NE(text.find("must be in ["), text.npos) << text;
    }
  }
}

// Whoever fills in the fields by hand is told, too.
TEST(MclSettingsLimits, FieldsTakeTheirWholeRangeAndNothingBeyond) {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  struct Field {
    const char* name;
    std::function<void(MclConfig&, double)> set;
    std::vector<double> fine;
    std::vector<double> wrong;
  };
  const std::vector<Field> fields = {
      {"resampleBelow", [](auto& c, double v) { c.resampleBelow = v; }, {0, 1}, {-0.01, 1.01}},
      {"kldError", [](auto& c, double v) { c.kldError = v; }, {0.01, 0.99}, {0, 1}},
      {"kldQuantile", [](auto& c, double v) { c.kldQuantile = v; }, {0.01, 9.99}, {0, 10}},
      {"binMetres", [](auto& c, double v) { c.binMetres = v; }, {1e-6}, {0, -1}},
      {"binRadians", [](auto& c, double v) { c.binRadians = v; }, {1e-6}, {0, -1}},
      {"startCandidates",
       [](auto& c, double v) { c.startCandidates = v; },
       {1, 1e5},
       {0.9, 100001}},
      {"recoverFast", [](auto& c, double v) { c.recoverFast = v; }, {0, 1}, {-0.01, 1.01}},
      {"recoverSlow", [](auto& c, double v) { c.recoverSlow = v; }, {0, 1}, {-0.01, 1.01}},
      {"minDistance", [](auto& c, double v) { c.minDistance = v; }, {0, kNoLimit}, {-0.01}},
      {"minRotation", [](auto& c, double v) { c.minRotation = v; }, {0, kNoLimit}, {-0.01}},
      {"maxInterval", [](auto& c, double v) { c.maxInterval = v; }, {0, kNoLimit}, {-0.01}},
      {"driftMetres", [](auto& c, double v) { c.driftMetres = v; }, {0, 100}, {-0.01, 100.01}},
      {"driftRadians", [](auto& c, double v) { c.driftRadians = v; }, {0, 100}, {-0.01, 100.01}},
      {"threads", [](auto& c, double v) { c.threads = static_cast<int>(v); }, {1, 256}, {0, 257}}};
  for (const Field& field : fields) {
    const auto complaint = [&](double value) {
      MclConfig c;
      field.set(c, value);
      return test::messageOf<std::invalid_argument>([&] { c.check(); });
    };
    for (const double fine : field.fine)
      EXPECT_EQ(complaint(fine), "(nothing was thrown)") << field.name;
    for (const double wrong : field.wrong)
      EXPECT_EQ(complaint(wrong).find(std::string("MclConfig.") + field.name + " is "), 0u)
          << field.name << " = " << wrong << ": " << complaint(wrong);
    if (std::string(field.name) == "threads") continue;  // a whole number
    EXPECT_NE(complaint(std::nan("")), "(nothing was thrown)") << field.name;
  }
}

}  // namespace
}  // namespace ortung
