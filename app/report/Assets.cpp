#include "Assets.hpp"

#include <cstddef>

// `ld -b binary` gives these names to the ends of a file.
#define ORTUNG_ASSET(name)                        \
  extern "C" const char _binary_##name##_start[]; \
  extern "C" const char _binary_##name##_end[]
ORTUNG_ASSET(uPlot_iife_min_js);
ORTUNG_ASSET(uPlot_min_css);
ORTUNG_ASSET(LICENSE);
ORTUNG_ASSET(report_css);
ORTUNG_ASSET(report_js);
#undef ORTUNG_ASSET

namespace ortung::app::assets {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view uPlotScript() {
  return between(_binary_uPlot_iife_min_js_start, _binary_uPlot_iife_min_js_end);
}
std::string_view uPlotStyle() {
  return between(_binary_uPlot_min_css_start, _binary_uPlot_min_css_end);
}
std::string_view uPlotLicence() { return between(_binary_LICENSE_start, _binary_LICENSE_end); }
std::string_view reportStyle() { return between(_binary_report_css_start, _binary_report_css_end); }
std::string_view reportScript() { return between(_binary_report_js_start, _binary_report_js_end); }

}  // namespace ortung::app::assets
