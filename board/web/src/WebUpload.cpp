#include "ortung/web/WebUpload.hpp"

namespace ortung {

WebUpload::~WebUpload() = default;

}  // namespace ortung
