#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

/**
 * Each test process has a temporary folder of its own: ctest runs the tests of one program side by
 * side, and files of one name in a shared folder would be another test's.
 */
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::string folder = testing::TempDir() + "graspbench_test_XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) {
    std::perror(folder.c_str());
    return 1;
  }
  setenv("TEST_TMPDIR", folder.c_str(), 1);
  const int status = RUN_ALL_TESTS();
  std::error_code ignored;  // what a test made unreadable stays
  std::filesystem::remove_all(folder, ignored);
  if (!GTEST_FLAG_GET(list_tests) && testing::UnitTest::GetInstance()->test_to_run_count() == 0) {
    std::fputs("no test has that name: nothing was tested\n", stderr);
    return 1;
  }
  return status;
}
