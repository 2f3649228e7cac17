#pragma once

#include <memory>

#include "ortung/camera/CameraModel.hpp"

namespace ortung {

// A source each. @throws ConfigError
std::shared_ptr<const CameraModel> makePerspective(const Parameters& camera);
std::shared_ptr<const CameraModel> makeFisheye(const Parameters& camera);
std::shared_ptr<const CameraModel> makeUnified(const Parameters& camera);
std::shared_ptr<const CameraModel> makeOcam(const Parameters& camera);
std::shared_ptr<const CameraModel> makeIsometric(const Parameters& camera);
std::shared_ptr<const CameraModel> makeTable(const Parameters& camera);

}  // namespace ortung
