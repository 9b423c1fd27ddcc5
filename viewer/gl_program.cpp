// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/gl_program.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

namespace geomap::viewer {
namespace {

std::string shader_log(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return log.c_str();
}

std::string program_log(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return log.c_str();
}

// Attached to the program, which then is the only one that keeps it.
void attach(GLuint program, const std::string& name, GLenum stage, const char* stage_name,
            std::string_view source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.data();
  const auto length = static_cast<GLint>(source.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint is_compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
  const std::string log = is_compiled == GL_TRUE ? std::string() : shader_log(shader);
  glAttachShader(program, shader);
  glDeleteShader(shader);
  if (is_compiled != GL_TRUE) {
    throw std::runtime_error(
        fmt::format("the {} shader of '{}' does not compile: {}", stage_name, name, log));
  }
}

GLuint linked(const std::string& name, const GlProgram::Sources& sources) {
  const GLuint program = glCreateProgram();
  try {
    attach(program, name, GL_VERTEX_SHADER, "vertex", sources.vertex);
    if (!sources.geometry.empty()) {
      attach(program, name, GL_GEOMETRY_SHADER, "geometry", sources.geometry);
    }
    attach(program, name, GL_FRAGMENT_SHADER, "fragment", sources.fragment);
    glLinkProgram(program);
    GLint is_linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &is_linked);
    if (is_linked != GL_TRUE) {
      throw std::runtime_error(
          fmt::format("the shaders of '{}' do not fit together: {}", name, program_log(program)));
    }
  } catch (...) {
    glDeleteProgram(program);
    throw;
  }
  return program;
}

// Asked for once: the driver compares names at each question.
std::vector<std::pair<std::string, int>> locations_of(GLuint program) {
  GLint count = 0;
  glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
  std::vector<std::pair<std::string, int>> locations;
  for (GLint i = 0; i < count; ++i) {
    std::array<char, 64> text{};
    GLint size = 0;
    GLenum type = 0;
    glGetActiveUniform(program, static_cast<GLuint>(i), static_cast<GLsizei>(text.size()), nullptr,
                       &size, &type, text.data());
    const std::string name = text.data();
    // An array is listed as its first element.
    locations.emplace_back(name.substr(0, name.find('[')),
                           glGetUniformLocation(program, name.c_str()));
  }
  return locations;
}

}  // namespace

GlProgram::GlProgram(const std::string& name, const Sources& sources)
    : program_(linked(name, sources)), locations_(locations_of(program_)) {}

GlProgram::~GlProgram() {
  if (program_ != 0) glDeleteProgram(program_);
}

GlProgram::GlProgram(GlProgram&& other) noexcept
    : program_(std::exchange(other.program_, 0U)), locations_(std::move(other.locations_)) {}

GlProgram& GlProgram::operator=(GlProgram&& other) noexcept {
  std::swap(program_, other.program_);
  std::swap(locations_, other.locations_);
  return *this;
}

void GlProgram::use() const { glUseProgram(program_); }

void GlProgram::set(const char* uniform, const Eigen::Matrix4d& value) const {
  const Eigen::Matrix4f single = value.cast<float>();
  glUniformMatrix4fv(location(uniform), 1, GL_FALSE, single.data());
}

void GlProgram::set(const char* uniform, const Eigen::Vector2f& value) const {
  glUniform2f(location(uniform), value.x(), value.y());
}

void GlProgram::set(const char* uniform, const Rgba& value) const {
  glUniform4fv(location(uniform), 1, value.data());
}

void GlProgram::set(const char* uniform, std::span<const Rgba> values) const {
  glUniform4fv(location(uniform), static_cast<GLsizei>(values.size()), values.front().data());
}

void GlProgram::set(const char* uniform, double value) const {
  glUniform1f(location(uniform), static_cast<float>(value));
}

int GlProgram::location(const char* uniform) const {
  for (const auto& [name, location] : locations_) {
    if (name == uniform) return location;
  }
  throw std::logic_error(fmt::format("the shader has no value '{}'", uniform));
}

}  // namespace geomap::viewer
