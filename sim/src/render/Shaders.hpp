#pragma once

namespace ortung::shaders {

/// The programs' parts in GLSL 3.30. `#define ANNOTATE` makes those that write things and ranges
/// instead of colours; `#define VARIED` those whose floor has a pattern.
extern const char* const kHead;  ///< the common part, behind the version and the definitions
extern const char* const kFloorVertex;
extern const char* const kFloorFragment;
extern const char* const kLineVertex;
extern const char* const kLineFragment;
extern const char* const kSolidVertex;
extern const char* const kSolidFragment;

}  // namespace ortung::shaders
