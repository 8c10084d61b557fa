#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace {
namespace fs = std::filesystem;

/** Gives each test a temporary folder of its own, and undoes what a test did to the environment
variables and to the working folder: the tests of one program run in one process. */
class Isolation : public testing::EmptyTestEventListener {
 public:
  explicit Isolation(const std::string& folder) : folder_(folder) {
    setenv("TEST_TMPDIR", folder_.c_str(), 1);
  }

 private:
  void OnTestStart(const testing::TestInfo&) override {
    for (char** variable = environ; *variable != nullptr; ++variable) {
      environment_.emplace_back(*variable);
    }
    working_folder_ = fs::current_path();
    const std::string own = folder_ + "/" + std::to_string(num_tests_++);
    fs::create_directory(own);
    setenv("TEST_TMPDIR", own.c_str(), 1);
  }

  void OnTestEnd(const testing::TestInfo&) override {
    std::error_code ignored;  // what a test made unreadable stays
    fs::remove_all(testing::TempDir(), ignored);
    fs::current_path(working_folder_, ignored);
    clearenv();
    for (const std::string& variable : environment_) {
      const size_t equals = variable.find('=');
      setenv(variable.substr(0, equals).c_str(), variable.c_str() + equals + 1, 1);
    }
    environment_.clear();
  }

  std::string folder_;
  fs::path working_folder_;
  std::vector<std::string> environment_;
  int num_tests_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::string folder = testing::TempDir() + "graspbench_test_XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) {
    std::perror(folder.c_str());
    return 1;
  }
  testing::UnitTest::GetInstance()->listeners().Append(new Isolation(folder));
  const int status = RUN_ALL_TESTS();
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  if (!GTEST_FLAG_GET(list_tests) && testing::UnitTest::GetInstance()->test_to_run_count() == 0) {
    std::fputs("no test has that name: nothing was tested\n", stderr);
    return 1;
  }
  return status;
}
