#include "core/render/gl_context.h"

// Keep this order: OSMesa brings the old GL header, which must find the types already there.
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <mutex>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/render/scene.h"

namespace graspbench {
namespace {

constexpr int kDummySize = 16;  // OSMesa wants a window; the pictures go to framebuffer objects

template <class Function>
Function FindSymbol(void* handle, const char* name, const std::string& library) {
  void* symbol = dlsym(handle, name);
  if (symbol == nullptr) {
    throw Error(ErrorKind::kEnvironment, "\"" + library + "\" has no function " + name +
                                             "; expected OSMesa 22 of the Debian package "
                                             "libosmesa6");
  }
  return reinterpret_cast<Function>(symbol);
}

/** Mesa maps the index of its shaders without allocating it, so that on a full disk the first look
at it would end the program with SIGBUS. @returns whether the disk has room for it. */
bool ReserveIndex(const std::filesystem::path& folder) {
  constexpr off_t kIndexSize = 8 + 65536 * 20;  // of Mesa 22 [bytes]
  MakePrivateFolder(folder / "mesa_shader_cache");
  const std::filesystem::path index = folder / "mesa_shader_cache" / "index";
  const int file = ::open(index.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) return false;
  const bool is_reserved = ::posix_fallocate(file, 0, kIndexSize) == 0;
  ::close(file);
  return is_reserved;
}

/** Mesa keeps compiled shaders, half a second of work, in a folder that only this user can write: it
runs what it finds there. Without one it compiles them every time, also where address space is
limited, of which keeping takes some 60 MB. A user's own setting wins. */
void KeepShaders() {
  if (std::getenv("MESA_SHADER_CACHE_DIR") || std::getenv("MESA_SHADER_CACHE_DISABLE")) return;
  try {
    rlimit space{};
    if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur == RLIM_INFINITY) {
      const std::filesystem::path folder = FindCacheRoot() / "shaders";
      MakePrivateFolder(folder);
      if (ReserveIndex(folder)) {
        setenv("MESA_SHADER_CACHE_DIR", folder.c_str(), /*overwrite=*/0);
        return;
      }
    }
  } catch (const Error&) {  // no folder: as without room
  }
  setenv("MESA_SHADER_CACHE_DISABLE", "true", /*overwrite=*/0);
}

}  // namespace

void DemandMemory(size_t size) {
  void* const probe =
      ::mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (probe == MAP_FAILED) {
    throw Error(ErrorKind::kEnvironment,
                "a picture takes up to " + std::to_string(size >> 20) +
                    " MB, which the machine, or a limit (ulimit -v), does not give; allow more");
  }
  ::munmap(probe, size);
}

void CompileShadersQuickly() { setenv("GALLIVM_PERF", "nopt", /*overwrite=*/0); }

struct GlContext::Library {
  decltype(&::OSMesaMakeCurrent) make_current = nullptr;
  decltype(&::OSMesaDestroyContext) destroy_context = nullptr;
  OSMesaContext context = nullptr;
  std::array<uint32_t, kDummySize * kDummySize> window{};

  ~Library() {
    if (context != nullptr) destroy_context(context);
  }
};

GlContext::GlContext(const std::string& library) : library_(std::make_unique<Library>()) {
  static std::once_flag once;
  std::call_once(once, KeepShaders);

  // Never closed: Mesa's threads and exit handlers live as long as the program.
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw Error(ErrorKind::kEnvironment,
                "pictures need the off-screen renderer OSMesa, which cannot be loaded (" +
                    std::string(dlerror()) + "); install the Debian package libosmesa6");
  }
  const auto create_context = FindSymbol<decltype(&::OSMesaCreateContextAttribs)>(
      handle, "OSMesaCreateContextAttribs", library);
  const auto find_function =
      FindSymbol<decltype(&::OSMesaGetProcAddress)>(handle, "OSMesaGetProcAddress", library);
  library_->make_current =
      FindSymbol<decltype(&::OSMesaMakeCurrent)>(handle, "OSMesaMakeCurrent", library);
  library_->destroy_context =
      FindSymbol<decltype(&::OSMesaDestroyContext)>(handle, "OSMesaDestroyContext", library);

  const std::array<int, 9> attributes = {OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_PROFILE,
                                         OSMESA_CORE_PROFILE,
                                         OSMESA_CONTEXT_MAJOR_VERSION,
                                         3,
                                         OSMESA_CONTEXT_MINOR_VERSION,
                                         3,
                                         0};
  library_->context = create_context(attributes.data(), nullptr);
  if (library_->context == nullptr) {
    throw Error(ErrorKind::kEnvironment,
                "OSMesa cannot make an OpenGL 3.3 core context; check the environment variables "
                "GALLIUM_DRIVER (llvmpipe or softpipe) and MESA_GL_VERSION_OVERRIDE (unset)");
  }
  MakeCurrent();
#define GRASPBENCH_LOAD(name) \
  functions_.name = reinterpret_cast<decltype(functions_.name)>(find_function("gl" #name));
  GRASPBENCH_FOR_EACH_GL_FUNCTION(GRASPBENCH_LOAD)
#undef GRASPBENCH_LOAD
#define GRASPBENCH_CHECK(name)                                                           \
  if (functions_.name == nullptr) {                                                      \
    throw Error(ErrorKind::kEnvironment, "OSMesa has no function gl" #name               \
                                         "; expected "                                   \
                                         "OpenGL 3.3 of the Debian package libosmesa6"); \
  }
  GRASPBENCH_FOR_EACH_GL_FUNCTION(GRASPBENCH_CHECK)
#undef GRASPBENCH_CHECK
}

GlContext::~GlContext() = default;

void GlContext::MakeCurrent() {
  if (!library_->make_current(library_->context, library_->window.data(), GL_UNSIGNED_BYTE,
                              kDummySize, kDummySize)) {
    throw Error(ErrorKind::kEnvironment, "OSMesa refuses to make its context current");
  }
}

}  // namespace graspbench
