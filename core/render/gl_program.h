#pragma once
/** @file
A compiled GLSL program and its uniforms. */

#include <Eigen/Core>
#include <string>

#include "core/base/error.h"
#include "core/render/gl_context.h"
#include "core/render/shaders.h"

namespace graspbench {

struct GlProgram {
  GLuint id = 0;
  const GlFunctions* gl = nullptr;

  GLint Find(const char* name) const { return gl->GetUniformLocation(id, name); }
  void Set(const char* name, int value) const { gl->Uniform1i(Find(name), value); }
  void Set(const char* name, double value) const {
    gl->Uniform1f(Find(name), static_cast<float>(value));
  }
  void Set(const char* name, const Eigen::Vector3f& value) const {
    gl->Uniform3fv(Find(name), 1, value.data());
  }
  void Set(const char* name, const Eigen::Vector3d& value) const {
    Set(name, Eigen::Vector3f(value.cast<float>()));
  }
  void Set(const char* name, const Eigen::Vector4d& value) const {
    gl->Uniform4fv(Find(name), 1, Eigen::Vector4f(value.cast<float>()).data());
  }
  void Set(const char* name, const Eigen::Matrix4d& value) const {
    gl->UniformMatrix4fv(Find(name), 1, GL_FALSE, Eigen::Matrix4f(value.cast<float>()).data());
  }
};

inline GLuint CompileShader(const GlFunctions& gl, GLenum stage, const char* name,
                            const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint is_compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
  char log[1024] = "";
  if (!is_compiled) gl.GetShaderInfoLog(shader, sizeof(log), nullptr, log);
  GRASPBENCH_DEMAND(is_compiled, std::string(name) + " shader: " + log);
  return shader;
}

/** A fault of a shader is one of ours. */
inline GlProgram MakeProgram(const GlFunctions& gl, const ShaderSource& source) {
  GlProgram program;
  program.gl = &gl;
  program.id = gl.CreateProgram();
  for (const GLuint shader :
       {CompileShader(gl, GL_VERTEX_SHADER, source.name, source.vertex),
        CompileShader(gl, GL_FRAGMENT_SHADER, source.name, source.fragment)}) {
    gl.AttachShader(program.id, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program.id);
  GLint is_linked = 0;
  gl.GetProgramiv(program.id, GL_LINK_STATUS, &is_linked);
  char log[1024] = "";
  if (!is_linked) gl.GetProgramInfoLog(program.id, sizeof(log), nullptr, log);
  GRASPBENCH_DEMAND(is_linked, std::string(source.name) + " program: " + log);
  return program;
}

}  // namespace graspbench
