#include "human_study/statistics/one_way_anova.h"

#include <gtest/gtest.h>

#include <cmath>

#include "human_study/statistics/t_tests.h"

namespace graspbench {
namespace {

// Data and certified values: NIST StRD, analysis of variance.

void ExpectCertified(const Answer<OneWayAnova>& anova, double ss_between, double ss_within,
                     double f, double relative_error) {
  ASSERT_TRUE(anova) << anova.reason();
  EXPECT_NEAR(anova->ss_between / ss_between, 1.0, relative_error);
  EXPECT_NEAR(anova->ss_within / ss_within, 1.0, relative_error);
  EXPECT_NEAR(anova->f / f, 1.0, relative_error);
}

TEST(OneWayAnova, AgreesWithNistSiRstv) {
  const auto anova = CalcOneWayAnova({{196.3052, 196.1240, 196.1890, 196.2569, 196.3403},
                                      {196.3042, 196.3825, 196.1669, 196.3257, 196.0422},
                                      {196.1303, 196.2005, 196.2889, 196.0343, 196.1811},
                                      {196.2795, 196.1748, 196.1494, 196.1485, 195.9885},
                                      {196.2119, 196.1051, 196.1850, 196.0052, 196.2090}});
  ExpectCertified(anova, 5.11462616000000e-02, 2.16636560000000e-01, 1.18046237440255, 1e-12);
  EXPECT_EQ(anova->df_between, 4.0);
  EXPECT_EQ(anova->df_within, 20.0);
}

TEST(OneWayAnova, AgreesWithNistAtmWtAg) {
  const auto anova = CalcOneWayAnova(
      {{107.8681568, 107.8681465, 107.8681572, 107.8681785, 107.8681446, 107.8681903,
        107.8681526, 107.8681494, 107.8681616, 107.8681587, 107.8681519, 107.8681486,
        107.8681419, 107.8681569, 107.8681508, 107.8681672, 107.8681385, 107.8681518,
        107.8681662, 107.8681424, 107.8681360, 107.8681333, 107.8681610, 107.8681477},
       {107.8681079, 107.8681344, 107.8681513, 107.8681197, 107.8681604, 107.8681385,
        107.8681642, 107.8681365, 107.8681151, 107.8681082, 107.8681517, 107.8681448,
        107.8681198, 107.8681482, 107.8681334, 107.8681609, 107.8681101, 107.8681512,
        107.8681469, 107.8681360, 107.8681254, 107.8681261, 107.8681450, 107.8681368}});
  ExpectCertified(anova, 3.63834187500000e-09, 1.04951729166667e-08, 1.59467335677930e+01, 1e-9);
}

/** SmLs01 to SmLs09: nine treatments about 1.4, 1.3, 1.5, 1.3, .. above `offset`, each once at its
middle and then 0.1 below and above in turn. */
std::vector<std::vector<double>> MakeSmLs(double offset, int num_replicates) {
  std::vector<std::vector<double>> groups;
  for (int treatment = 0; treatment < 9; ++treatment) {
    const int tenths = treatment == 0 ? 4 : treatment % 2 == 1 ? 3 : 5;
    // As a reader of the file would get them: the double nearest to the decimal.
    const auto make = [&](int own) { return (offset * 10.0 + own) / 10.0; };
    std::vector<double> group = {make(tenths)};
    while (static_cast<int>(group.size()) < num_replicates) {
      group.insert(group.end(), {make(tenths - 1), make(tenths + 1)});
    }
    groups.push_back(group);
  }
  return groups;
}

TEST(OneWayAnova, AgreesWithNistSmLsAsFarAsTheValuesAreRepresentable) {
  const struct {
    int num_replicates;
    double ss_between, ss_within, f;
  } certified[] = {
      {21, 1.68, 1.80, 21.0}, {201, 16.08, 18.0, 201.0}, {2001, 160.08, 180.0, 2001.0}};
  // 1.4; 1,000,000.4 is off by up to 6e-11; 1,000,000,000,000.4 by up to 6e-5.
  const std::pair<double, double> offsets[] = {{1.0, 1e-13}, {1e6, 1e-8}, {1e12, 5e-3}};
  for (const auto& [offset, relative_error] : offsets) {
    for (const auto& known : certified) {
      SCOPED_TRACE(std::to_string(offset) + ", " + std::to_string(known.num_replicates));
      ExpectCertified(CalcOneWayAnova(MakeSmLs(offset, known.num_replicates)), known.ss_between,
                      known.ss_within, known.f, relative_error);
    }
  }
}

TEST(OneWayAnova, GivesReasons) {
  EXPECT_EQ(CalcOneWayAnova({}).reason(), "0 groups; expected 2 or more");
  EXPECT_EQ(CalcOneWayAnova({{1, 2}, {}}).reason(), "1 group; expected 2 or more");
  EXPECT_EQ(CalcOneWayAnova({{1}, {2}}).reason(),
            "every group has a single value: no spread within");
  EXPECT_EQ(CalcOneWayAnova({{0.1, 0.1}, {0.2, 0.2}}).reason(),
            "the values of every group are equal: no spread within");
  EXPECT_EQ(CalcOneWayAnova({{1, NAN}, {2, 3}}).reason(), "a value is not finite");
  EXPECT_TRUE(CalcOneWayAnova({{1, 2}, {}, {3}}));
}

}  // namespace
}  // namespace graspbench
