#pragma once

#include <initializer_list>
#include <string>

#include "GlContext.hpp"

namespace ortung {

/// A linked program. @pre its context is current, whenever it is used
class GlProgram {
 public:
  GlProgram() = default;
  /// @param definitions lines of the preprocessor
  /// @throws std::runtime_error with what the compiler says
  GlProgram(const GlFunctions& gl, const std::string& definitions,
            std::initializer_list<const char*> vertex, std::initializer_list<const char*> fragment);

  void use() const { gl_->UseProgram(program_); }
  /// Returns the location of a uniform; -1, which OpenGL ignores, if the compiler removed it.
  GLint find(const char* name) const { return gl_->GetUniformLocation(program_, name); }

 private:
  GLuint compile(GLenum kind, const std::string& definitions,
                 std::initializer_list<const char*> parts) const;
  const GlFunctions* gl_ = nullptr;
  GLuint program_ = 0;
};

}  // namespace ortung
