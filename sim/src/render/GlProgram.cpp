#include "GlProgram.hpp"

#include <array>
#include <stdexcept>
#include <vector>

namespace ortung {
namespace {

constexpr GLsizei kLongestLog = 2000;

}  // namespace

GlProgram::GlProgram(const GlFunctions& gl, const std::string& definitions,
                     std::initializer_list<const char*> vertex,
                     std::initializer_list<const char*> fragment)
    : gl_(&gl), program_(gl.CreateProgram()) {
  gl.AttachShader(program_, compile(GL_VERTEX_SHADER, definitions, vertex));
  gl.AttachShader(program_, compile(GL_FRAGMENT_SHADER, definitions, fragment));
  gl.LinkProgram(program_);
  GLint done = GL_FALSE;
  gl.GetProgramiv(program_, GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return;
  std::array<char, kLongestLog> log{};
  gl.GetProgramInfoLog(program_, kLongestLog, nullptr, log.data());
  throw std::runtime_error(std::string("OpenGL does not link a program of ours: ") + log.data());
}

GLuint GlProgram::compile(GLenum kind, const std::string& definitions,
                          std::initializer_list<const char*> parts) const {
  const std::string begin = "#version 330 core\n" + definitions;
  std::vector<const char*> texts{begin.c_str()};
  texts.insert(texts.end(), parts);
  const GLuint shader = gl_->CreateShader(kind);
  gl_->ShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), nullptr);
  gl_->CompileShader(shader);
  GLint done = GL_FALSE;
  gl_->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  std::array<char, kLongestLog> log{};
  gl_->GetShaderInfoLog(shader, kLongestLog, nullptr, log.data());
  throw std::runtime_error(std::string("OpenGL does not compile a shader of ours: ") + log.data());
}

}  // namespace ortung
