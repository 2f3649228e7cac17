#pragma once

namespace ortung::shaders {

/// The programs' parts in GLSL 3.30. `#define ANNOTATE` makes those that tell what is where
/// instead of what it looks like; `#define VARIED` those whose floor has a pattern.
extern const char* const kHead;  ///< behind the version and the definitions, before all others
extern const char* const kFloorVertex;
extern const char* const kFloorFragment;
extern const char* const kLineVertex;
extern const char* const kLineFragment;
extern const char* const kSolidVertex;
extern const char* const kSolidFragment;

}  // namespace ortung::shaders
