// An installed program finds its data beside itself, wherever it was moved to.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/files/files.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class InstallTest : public testing::Test {
 protected:
  void SetUp() override {
    ::unsetenv("GRASPBENCH_HOME");
    fs::create_directories(folder_);
    Run("cmake --install " GRASPBENCH_BUILD_FOLDER " --prefix " + (folder_ / "first").string());
    fs::rename(folder_ / "first", moved_);
  }
  ~InstallTest() override {
    std::error_code status;
    fs::remove_all(folder_, status);
  }
  /** What it prints; fails the test unless it returns 0. */
  std::string Run(const std::string& command) {
    const fs::path out = folder_ / "out.txt";
    const std::string line = command + " >" + out.string() + " 2>&1";
    EXPECT_EQ(std::system(line.c_str()), 0) << ReadFile(out);
    return ReadFile(out);
  }
  std::string program() const { return (moved_ / "bin" / "graspbench").string(); }

  fs::path folder_ = fs::path(testing::TempDir()) / ("install_test_" + std::to_string(::getpid()));
  fs::path moved_ = folder_ / "else where";
};

TEST_F(InstallTest, TheTreeMayBeMoved) {
  // Not the catalogue of the source tree: this name stands nowhere else.
  const fs::path file = moved_ / "share/graspbench/objects/catalogue/can/object.yaml";
  std::string text = ReadFile(file);
  text.replace(text.find("name: can"), 9, "name: installed can");
  WriteFile(file, text);
  const std::string quoted = "'" + program() + "' ";
  EXPECT_EQ(Run(quoted + "object show can").find("installed can (can)\n"), 0u);
  EXPECT_NE(Run(quoted + "hand check tum").find("\ntum: can be used"), std::string::npos);

  // The reader of foreign meshes came along.
  WriteFile(folder_ / "a.stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 0\n"
            "endloop\nendfacet\nendsolid a\n");
  EXPECT_NE(Run("(" + quoted + "object check " + (folder_ / "a.stl").string() + " || true)")
                .find("a.stl: 1 triangle, 3 open edges"),
            std::string::npos);
}

TEST_F(InstallTest, CompletionAndManPageAreInstalled) {
  for (const char* name :
       {"share/bash-completion/completions/graspbench", "share/zsh/site-functions/_graspbench",
        "share/fish/vendor_completions.d/graspbench.fish", "share/man/man1/graspbench.1"}) {
    EXPECT_NE(ReadFile(moved_ / name).find("object"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace graspbench
