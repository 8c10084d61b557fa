#include "core/base/text/yaml.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"

namespace graspbench {
namespace {

class YamlTest : public testing::Test {
 protected:
  std::string Write(const std::string& text) {
    // Tests run in parallel: a file of its own for each.
    const auto path = std::filesystem::path(testing::TempDir()) /
                      testing::UnitTest::GetInstance()->current_test_info()->name();
    WriteFileAtomically(path, text);
    return path.string();
  }
  Diagnostics problems_;
};

TEST_F(YamlTest, ReadsValuesAndKeepsDefaults) {
  const std::string path = Write("mass_kg: 0.5\nsize_m: [1, 2, 3]\n");
  YamlMap map(LoadYaml(path, problems_), "f", "object", problems_);
  double mass = 0.0, density = 7.0;
  Eigen::Vector3d size;
  map.Read("mass_kg", mass);
  map.Read("density", density, Needed::kNo);
  map.Read("size_m", size);
  map.FinishKnownKeys();
  EXPECT_EQ(problems_.num_errors(), 0) << problems_.Format();
  EXPECT_EQ(mass, 0.5);
  EXPECT_EQ(density, 7.0);
  EXPECT_EQ(size, Eigen::Vector3d(1, 2, 3));
}

// YAML takes what follows " #" for a comment.
TEST_F(YamlTest, AKeyWithoutValueIsTold) {
  const std::string path = Write("name: ball\ncolour: #ff00ff\n");
  YamlMap map(LoadYaml(path, problems_), "o.yaml", "object", problems_);
  std::string name, colour = "red";
  map.Read("name", name);
  map.Read("colour", colour, Needed::kNo);
  EXPECT_EQ(problems_.num_errors(), 1);
  EXPECT_NE(
      problems_.Format().find("o.yaml:2: error: object, colour: the value is missing; one that "
                              "begins with # needs quotes"),
      std::string::npos)
      << problems_.Format();
}

TEST_F(YamlTest, ReportsEveryProblemWithItsLine) {
  const std::string path = Write("mass_kg: heavy\nsize_m: [1, .nan, 3]\nmu_statc: 0.3\n");
  YamlMap map(LoadYaml(path, problems_), "o.yaml", "object", problems_);
  double mass = 0.0, mu = 0.0;
  Eigen::Vector3d size;
  map.Read("mass_kg", mass);
  map.Read("size_m", size);
  map.Read("mu_static", mu);
  map.FinishKnownKeys();
  EXPECT_EQ(problems_.Format(),
            "o.yaml:1: error: object, mass_kg: expected a finite number\n"
            "o.yaml:2: error: object, size_m: expected three finite numbers in brackets\n"
            "o.yaml:1: error: object: the key \"mu_static\" is missing\n"
            "o.yaml:3: error: object: unknown key \"mu_statc\"; did you mean \"mu_static\"? "
            "Known: mass_kg, size_m, mu_static");
}

TEST_F(YamlTest, ReportsBrokenSyntaxWithItsLine) {
  const std::string path = Write("a: 1\nb: [1, 2\n");
  LoadYaml(path, problems_);
  ASSERT_EQ(problems_.num_errors(), 1);
  EXPECT_NE(problems_.Format().find("not valid YAML"), std::string::npos);
}

TEST_F(YamlTest, AMapIsExpected) {
  YamlMap map(LoadYaml(Write("- 1\n- 2\n"), problems_), "o.yaml", "object", problems_);
  EXPECT_EQ(problems_.Format(), "o.yaml:1: error: object: expected a map of keys and values");
}

TEST_F(YamlTest, AKeyGivenTwiceIsToldWithItsLine) {
  YamlMap map(ParseYaml("size: 1\nsize: 2\n", "o.yaml", problems_), "o.yaml", "object", problems_);
  double size = 0.0;
  map.Read("size", size);
  map.FinishKnownKeys();
  EXPECT_EQ(problems_.Format(), "o.yaml:2: error: object: \"size\" is given twice");
}

}  // namespace
}  // namespace graspbench
