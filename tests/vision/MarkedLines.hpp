#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ortung/camera/CameraModel.hpp"

namespace ortung {

/// Lines of one picture, marked by hand (tests/data/vision/README.md).
struct MarkedPicture {
  struct Vertex {
    double u, v, width;
  };
  std::string file;
  std::vector<std::vector<Vertex>> lines;
  std::vector<std::vector<Pixel>> unsure;

  /// How far a pixel lies outside the nearest line's width [px]; 0: on a line.
  double distanceTo(const Pixel& p) const {
    double best = 1e9;
    eachPiece([&](const Vertex& a, const Vertex& b) {
      const double du = b.u - a.u, dv = b.v - a.v;
      const double squared = du * du + dv * dv;
      const double t =
          squared > 0 ? std::clamp(((p.u - a.u) * du + (p.v - a.v) * dv) / squared, 0.0, 1.0) : 0.0;
      const double away = std::hypot(p.u - a.u - t * du, p.v - a.v - t * dv);
      best = std::min(best, std::max(0.0, away - 0.5 * (a.width + t * (b.width - a.width))));
    });
    return best;
  }

  bool isUnsure(const Pixel& p) const {
    return std::any_of(unsure.begin(), unsure.end(), [&](const std::vector<Pixel>& polygon) {
      bool isInside = false;
      for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
        if ((polygon[i].v > p.v) != (polygon[j].v > p.v) &&
            p.u < (polygon[j].u - polygon[i].u) * (p.v - polygon[i].v) /
                          (polygon[j].v - polygon[i].v) +
                      polygon[i].u)
          isInside = !isInside;
      return isInside;
    });
  }

  template <typename What>
  void eachPiece(const What& what) const {
    for (const auto& line : lines)
      for (std::size_t i = 1; i < line.size(); ++i) what(line[i - 1], line[i]);
  }
};

inline std::vector<MarkedPicture> readMarks(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<MarkedPicture> pictures;
  const nlohmann::json marks = nlohmann::json::parse(in);
  for (const auto& image : marks.at("images")) {
    MarkedPicture picture{image.at("file"), {}, {}};
    for (const auto& line : image.at("lines")) {
      picture.lines.emplace_back();
      for (const auto& v : line) picture.lines.back().push_back({v.at(0), v.at(1), v.at(2)});
    }
    for (const auto& polygon : image.at("unsure")) {
      picture.unsure.emplace_back();
      for (const auto& v : polygon) picture.unsure.back().push_back({v.at(0), v.at(1)});
    }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace ortung
