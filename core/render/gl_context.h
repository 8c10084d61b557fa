#pragma once
/** @file
An off-screen OpenGL 3.3 core context and its functions.

OSMesa (Mesa's software renderer, no display, no GPU) is loaded when the first context is made, and
every function comes from its own loader. Calling a linked gl* symbol instead would reach libGL if
that comes first, and every picture would be black without any error; so nothing here is linked.

Mesa 25.1 dropped OSMesa. A successor (EGL without a surface) replaces gl_context.cc alone. */

#define GL_GLEXT_PROTOTYPES  // for the types only
#include <GL/glcorearb.h>

#include <memory>
#include <string>

namespace graspbench {

/** The functions in use, without their prefix: gl.Clear(...) is glClear(...). */
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

/** Mesa ends the program where it gets no memory, so it is asked before.
@throws Error(kEnvironment) when so many bytes are not to be had. */
void DemandMemory(size_t size);

class GlContext {
 public:
  /** @throws Error(kEnvironment) when the library or one of its functions is missing, or it cannot
  make a 3.3 core context. */
  explicit GlContext(const std::string& library = "libOSMesa.so.8");
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /** Directs this thread's calls to this context. */
  void MakeCurrent();
  const GlFunctions& functions() const { return functions_; }

 private:
  struct Library;
  std::unique_ptr<Library> library_;
  GlFunctions functions_;
};

}  // namespace graspbench
