#include "core/render/gl_context.h"

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

constexpr char kAdvice[] =
    "check the environment variables GALLIUM_DRIVER (llvmpipe or softpipe) and "
    "MESA_GL_VERSION_OVERRIDE (unset)";

/** A library that is loaded at first use and never closed: Mesa's threads and exit handlers live as
long as the program. */
class LoadedLibrary {
 public:
  explicit LoadedLibrary(const std::string& name)
      : name_(name), handle_(::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr) reason_ = ::dlerror();
  }
  /** Empty: it is loaded. */
  const std::string& reason() const { return reason_; }

  template <class Function>
  void Find(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(::dlsym(handle_, name));
    if (function == nullptr) {
      throw Error(ErrorKind::kEnvironment,
                  "\"" + name_ + "\" has no function " + name +
                      "; expected that of the Debian package libosmesa6 or libegl1");
    }
  }

 private:
  std::string name_;
  void* handle_;
  std::string reason_;
};

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

struct GlContext::Maker {
  virtual ~Maker() = default;
  virtual void* Find(const char* function) const = 0;
  virtual bool MakeCurrent() = 0;
};

namespace {

/** Constants and functions are those of the header of OSMesa, which newer systems do not have. */
class OsmesaMaker : public GlContext::Maker {
 public:
  explicit OsmesaMaker(const LoadedLibrary& library) {
    void* (*create)(const int*, void*) = nullptr;
    library.Find("OSMesaCreateContextAttribs", create);
    library.Find("OSMesaGetProcAddress", find_);
    library.Find("OSMesaMakeCurrent", make_current_);
    library.Find("OSMesaDestroyContext", destroy_);
    constexpr int kFormat = 0x22, kRgba = 0x1908, kProfile = 0x33, kCoreProfile = 0x34,
                  kMajorVersion = 0x36, kMinorVersion = 0x37;
    const std::array<int, 9> attributes = {
        kFormat, kRgba, kProfile, kCoreProfile, kMajorVersion, 3, kMinorVersion, 3, 0};
    context_ = create(attributes.data(), nullptr);
    if (context_ == nullptr) {
      throw Error(ErrorKind::kEnvironment,
                  std::string("OSMesa cannot make an OpenGL 3.3 core context; ") + kAdvice);
    }
  }
  ~OsmesaMaker() override {
    if (context_ != nullptr) destroy_(context_);
  }
  void* Find(const char* function) const override {
    return reinterpret_cast<void*>(find_(function));
  }
  bool MakeCurrent() override {
    return make_current_(context_, window_.data(), GL_UNSIGNED_BYTE, kDummySize, kDummySize) != 0;
  }

 private:
  void (*(*find_)(const char*))() = nullptr;
  unsigned char (*make_current_)(void*, void*, unsigned, int, int) = nullptr;
  void (*destroy_)(void*) = nullptr;
  void* context_ = nullptr;
  std::array<uint32_t, kDummySize * kDummySize> window_{};
};

/** Mesa's software renderer by EGL without a surface (EGL_MESA_platform_surfaceless); constants and
functions are those of the headers of EGL. */
class EglMaker : public GlContext::Maker {
 public:
  explicit EglMaker(const LoadedLibrary& library) {
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "true", /*overwrite=*/0);  // the same pictures everywhere
    library.Find("eglGetProcAddress", find_);
    library.Find("eglMakeCurrent", make_current_);
    library.Find("eglDestroyContext", destroy_);
    void* (*get_display)(unsigned, void*, const intptr_t*) = nullptr;
    unsigned (*initialize)(void*, int*, int*) = nullptr;
    unsigned (*bind)(unsigned) = nullptr;
    void* (*create)(void*, void*, void*, const int*) = nullptr;
    library.Find("eglGetPlatformDisplay", get_display);
    library.Find("eglInitialize", initialize);
    library.Find("eglBindAPI", bind);
    library.Find("eglCreateContext", create);
    constexpr unsigned kSurfaceless = 0x31DD, kOpenGl = 0x30A2;
    constexpr int kMajorVersion = 0x3098, kMinorVersion = 0x30FB, kProfile = 0x30FD, kCore = 1,
                  kNone = 0x3038;
    const std::array<int, 7> attributes = {kMajorVersion, 3,     kMinorVersion, 3,
                                           kProfile,      kCore, kNone};
    display_ = get_display(kSurfaceless, nullptr, nullptr);
    if (display_ != nullptr && initialize(display_, nullptr, nullptr) && bind(kOpenGl)) {
      context_ = create(display_, nullptr, nullptr, attributes.data());
    }
    if (context_ == nullptr) {
      throw Error(ErrorKind::kEnvironment,
                  std::string("EGL cannot make an OpenGL 3.3 core context without a surface; it "
                              "needs Mesa (Debian package libegl-mesa0); ") +
                      kAdvice);
    }
  }
  ~EglMaker() override {
    if (context_ == nullptr) return;
    make_current_(display_, nullptr, nullptr, nullptr);
    destroy_(display_, context_);
  }
  void* Find(const char* function) const override {
    return reinterpret_cast<void*>(find_(function));
  }
  bool MakeCurrent() override { return make_current_(display_, nullptr, nullptr, context_) != 0; }

 private:
  void (*(*find_)(const char*))() = nullptr;
  unsigned (*make_current_)(void*, void*, void*, void*) = nullptr;
  unsigned (*destroy_)(void*, void*) = nullptr;
  void* display_ = nullptr;
  void* context_ = nullptr;
};

std::unique_ptr<GlContext::Maker> LoadMaker(const std::string& osmesa, const std::string& egl) {
  const LoadedLibrary first(osmesa);
  if (first.reason().empty()) return std::make_unique<OsmesaMaker>(first);
  const LoadedLibrary second(egl);
  if (second.reason().empty()) return std::make_unique<EglMaker>(second);
  throw Error(ErrorKind::kEnvironment,
              "pictures need the off-screen renderer of Mesa, which cannot be loaded (" +
                  first.reason() + "; " + second.reason() +
                  "); install the Debian package libosmesa6 or libegl1");
}

}  // namespace

GlContext::GlContext(const std::string& osmesa, const std::string& egl) {
  static std::once_flag once;
  std::call_once(once, KeepShaders);
  maker_ = LoadMaker(osmesa, egl);
  MakeCurrent();
#define GRASPBENCH_LOAD(name) \
  functions_.name = reinterpret_cast<decltype(functions_.name)>(maker_->Find("gl" #name));
  GRASPBENCH_FOR_EACH_GL_FUNCTION(GRASPBENCH_LOAD)
#undef GRASPBENCH_LOAD
#define GRASPBENCH_CHECK(name)                                                           \
  if (functions_.name == nullptr) {                                                      \
    throw Error(ErrorKind::kEnvironment, "Mesa has no function gl" #name                 \
                                         "; expected "                                   \
                                         "OpenGL 3.3 of the Debian package libosmesa6"); \
  }
  GRASPBENCH_FOR_EACH_GL_FUNCTION(GRASPBENCH_CHECK)
#undef GRASPBENCH_CHECK
}

GlContext::~GlContext() = default;

void GlContext::MakeCurrent() {
  if (!maker_->MakeCurrent()) {
    throw Error(ErrorKind::kEnvironment, "Mesa refuses to make its context current");
  }
}

}  // namespace graspbench
