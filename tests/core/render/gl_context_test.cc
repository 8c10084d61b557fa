#include "core/render/gl_context.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <iterator>

#include "core/base/error.h"
#include "core/render/scene.h"

namespace graspbench {
namespace {

TEST(GlContextTest, NamesThePackagesOfMissingLibraries) {
  try {
    const GlContext context("libNoSuchMesa.so.8", "libNoSuchEgl.so.1");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kEnvironment);
    EXPECT_STREQ(error.what(),
                 "pictures need the off-screen renderer of Mesa, which cannot be loaded "
                 "(libNoSuchMesa.so.8: cannot open shared object file: No such file or directory; "
                 "libNoSuchEgl.so.1: cannot open shared object file: No such file or directory); "
                 "install the Debian package libosmesa6 or libegl1");
  }
}

/** The colour that a cleared picture has. */
std::array<uint8_t, 4> ClearAndRead(const GlContext& context) {
  const GlFunctions& gl = context.functions();
  GLuint texture = 0, target = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl.GenFramebuffers(1, &target);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  EXPECT_EQ(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), GLenum{GL_FRAMEBUFFER_COMPLETE});
  gl.ClearColor(1.0F, 0.2F, 0.4F, 0.6F);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  std::array<uint8_t, 4> pixel{};
  gl.ReadPixels(2, 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  EXPECT_EQ(gl.GetError(), GLenum{GL_NO_ERROR});
  return pixel;
}

// In a process of its own: two builds of Mesa do not meet.
TEST(GlContextTest, WithoutOsmesaEglDraws) {
  if (::dlopen("libEGL_mesa.so.0", RTLD_NOW | RTLD_LOCAL) == nullptr) {
    GTEST_SKIP() << "Debian's package libegl-mesa0 is not installed";
  }
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto draw = [] {
    GlContext context("libNoSuchMesa.so.8");
    GlContext other("libNoSuchMesa.so.8");
    const std::array<uint8_t, 4> right = {255, 51, 102, 153};
    context.MakeCurrent();
    const bool is_right = ClearAndRead(context) == right;
    other.MakeCurrent();
    std::exit(is_right && ClearAndRead(other) == right ? 0 : 1);
  };
  EXPECT_EXIT(draw(), testing::ExitedWithCode(0), "");
}

// In a process of its own: Mesa looks for its folder once.
TEST(GlContextTest, CompiledShadersAreKeptInAPrivateFolder) {
  namespace fs = std::filesystem;
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  // That process has another TempDir().
  setenv("GRASPBENCH_KEPT_SHADERS", (testing::TempDir() + "/kept_shaders").c_str(), 0);
  const fs::path cache = std::getenv("GRASPBENCH_KEPT_SHADERS");
  fs::remove_all(cache);
  EXPECT_EXIT(
      {
        unsetenv("MESA_SHADER_CACHE_DIR");
        unsetenv("MESA_SHADER_CACHE_DISABLE");
        setenv("XDG_CACHE_HOME", cache.c_str(), 1);
        Renderer(64, 48).Render(Scene(), Camera());
        std::exit(0);
      },
      testing::ExitedWithCode(0), "");
  const fs::path folder = cache / "graspbench" / "shaders";
  ASSERT_TRUE(fs::is_directory(folder));
  EXPECT_EQ(fs::status(folder).permissions() & fs::perms::all, fs::perms::owner_all);
  const auto num_files =
      std::distance(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator());
  EXPECT_GT(num_files, 3);  // more than the index and its folder
  // Without blocks of its own, the index would be a SIGBUS on a full disk.
  struct stat index;
  ASSERT_EQ(::stat((folder / "mesa_shader_cache" / "index").c_str(), &index), 0);
  EXPECT_EQ(index.st_size, 8 + 65536 * 20) << "another Mesa?";
  EXPECT_GE(index.st_blocks * 512, index.st_size);
  fs::remove_all(cache);
}

}  // namespace
}  // namespace graspbench
