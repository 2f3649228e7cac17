#include "Painters.hpp"

#include <stdexcept>
#include <string>

namespace ortung {
namespace {

void check(const Drawing& drawing, const Sheet& sheet) {
  const auto isSide = [](int side) { return side >= 1 && side <= Drawing::kMostPixels; };
  if (!isSide(drawing.width) || !isSide(drawing.height))
    throw std::invalid_argument("a drawing of " + std::to_string(drawing.width) + " x " +
                                std::to_string(drawing.height) +
                                " pixels, expected 1 to 8192 to a side");
  const auto size =
      static_cast<std::size_t>(drawing.width) * static_cast<std::size_t>(drawing.height);
  if (sheet.colours.size() != size)
    throw std::invalid_argument("a sheet of " + std::to_string(sheet.colours.size()) +
                                " pixels, expected " + std::to_string(size));
}

}  // namespace

struct Painters::Painter {
  explicit Painter(const StandingScene& scene) : painter(scene) {}
  ScenePainter painter;
  std::vector<Instance> moving;
};

Painters::Painters() = default;
Painters::~Painters() = default;

std::unique_ptr<Painters::Painter> Painters::take(const WorldModel& world,
                                                  std::span<const WorldObject> standing) {
  const std::lock_guard lock(mutex_);
  if (!scene_) scene_ = std::make_unique<const StandingScene>(standingScene(world, standing));
  if (idle_.empty()) return std::make_unique<Painter>(*scene_);
  std::unique_ptr<Painter> taken = std::move(idle_.back());
  idle_.pop_back();
  return taken;
}

void Painters::draw(const WorldModel& world, std::span<const WorldObject> objects,
                    std::size_t standing, const Drawing& drawing, const Sheet& sheet) {
  check(drawing, sheet);
  std::unique_ptr<Painter> one = take(world, objects.first(standing));
  one->moving.clear();
  for (std::size_t i = standing; i < objects.size(); ++i)
    if (drawing.ignore == 0 || objects[i].robot != drawing.ignore)
      addInstances(objects[i], i, one->moving);
  one->painter.draw(drawing, one->moving, sheet);
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(one));
}

}  // namespace ortung
