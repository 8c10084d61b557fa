#pragma once
/** @file
An off-screen OpenGL 3.3 core context and its functions.

Mesa's software renderer (no display, no GPU) is loaded when the first context is created: as
OSMesa, or, if OSMesa is missing (Mesa 25.1 dropped it), as EGL without a surface. Every function
comes from the library's own loader. A call of a linked gl* symbol would reach libGL if that is
loaded first, and every picture would be black without any error. So nothing is linked here. */

#define GL_GLEXT_PROTOTYPES  // for the types only
#include <GL/glcorearb.h>

#include <Eigen/Core>
#include <memory>
#include <string>

#include "core/base/error.h"
#include "core/render/shaders.h"

namespace graspbench {

/** The functions used, without their prefix: gl.Clear(...) is glClear(...). */
#define GRASPBENCH_FOR_EACH_GL_FUNCTION(X) \
  X(ActiveTexture)                         \
  X(AttachShader)                          \
  X(BindBuffer)                            \
  X(BindFramebuffer)                       \
  X(BindSampler)                           \
  X(BindTexture)                           \
  X(BindVertexArray)                       \
  X(BufferData)                            \
  X(CheckFramebufferStatus)                \
  X(Clear)                                 \
  X(ClearColor)                            \
  X(CompileShader)                         \
  X(CreateProgram)                         \
  X(CreateShader)                          \
  X(CullFace)                              \
  X(DeleteBuffers)                         \
  X(DeleteShader)                          \
  X(DeleteVertexArrays)                    \
  X(Disable)                               \
  X(DrawArrays)                            \
  X(DrawBuffer)                            \
  X(DrawElements)                          \
  X(Enable)                                \
  X(EnableVertexAttribArray)               \
  X(FramebufferTexture2D)                  \
  X(GenBuffers)                            \
  X(GenFramebuffers)                       \
  X(GenSamplers)                           \
  X(GenTextures)                           \
  X(GenVertexArrays)                       \
  X(GetError)                              \
  X(GetProgramInfoLog)                     \
  X(GetProgramiv)                          \
  X(GetShaderInfoLog)                      \
  X(GetShaderiv)                           \
  X(GetUniformLocation)                    \
  X(LinkProgram)                           \
  X(PixelStorei)                           \
  X(PolygonOffset)                         \
  X(ReadBuffer)                            \
  X(ReadPixels)                            \
  X(SamplerParameteri)                     \
  X(ShaderSource)                          \
  X(TexImage2D)                            \
  X(TexParameteri)                         \
  X(Uniform1f)                             \
  X(Uniform1i)                             \
  X(Uniform3fv)                            \
  X(Uniform4fv)                            \
  X(UniformMatrix4fv)                      \
  X(UseProgram)                            \
  X(VertexAttribPointer)                   \
  X(Viewport)

struct GlFunctions {
// NOLINTNEXTLINE(bugprone-macro-parentheses): a declared name takes none.
#define GRASPBENCH_DECLARE(name) decltype(&::gl##name) name = nullptr;
  GRASPBENCH_FOR_EACH_GL_FUNCTION(GRASPBENCH_DECLARE)
#undef GRASPBENCH_DECLARE
};

/** Checks in advance that this much memory is available, because Mesa aborts the program if an
allocation fails.
@throws Error(kEnvironment) if the memory is not available. */
void DemandMemory(size_t size);

class GlContext {
 public:
  /** Creates a context of OSMesa or, if that library is missing, of EGL.
  @throws Error(kEnvironment) if both libraries or a function are missing, or if no 3.3 core context
  can be created. */
  explicit GlContext(const std::string& osmesa = "libOSMesa.so.8",
                     const std::string& egl = "libEGL.so.1");
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /** Directs this thread's calls to this context. */
  void MakeCurrent();
  const GlFunctions& functions() const { return functions_; }

  /** Creates contexts with one library. */
  struct Maker;

 private:
  std::unique_ptr<Maker> maker_;
  GlFunctions functions_;
};

/** A compiled GLSL program and its uniforms. */
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

/** Compiles and links a program. A faulty shader is a bug of ours and aborts. */
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
