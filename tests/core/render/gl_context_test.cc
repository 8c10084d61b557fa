#include "core/render/gl_context.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>

#include "core/base/error.h"
#include "core/render/scene.h"

namespace graspbench {
namespace {

std::string FindMessage(const std::string& library) {
  try {
    GlContext context(library);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kEnvironment);
    return error.what();
  }
  return "no error";
}

TEST(GlContextTest, NamesThePackageOfAMissingLibrary) {
  EXPECT_EQ(FindMessage("libNoSuchMesa.so.8"),
            "pictures need the off-screen renderer OSMesa, which cannot be loaded "
            "(libNoSuchMesa.so.8: cannot open shared object file: No such file or directory); "
            "install the Debian package libosmesa6");
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
