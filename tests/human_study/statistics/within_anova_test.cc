#include "human_study/statistics/within_anova.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/statistics/distributions.h"
#include "core/statistics/multiple_tests.h"
#include "human_study/statistics/condition_means.h"
#include "human_study/statistics/location_tests.h"
#include "tests/human_study/statistics/known_studies.h"

namespace graspbench {

namespace {

CellMeans MakeCells(std::vector<Factor> factors, const Eigen::MatrixXd& means) {
  CellMeans cells;
  cells.cells = ListCells(factors);
  cells.factors = std::move(factors);
  cells.means = means;
  for (Eigen::Index p = 0; p < means.rows(); ++p) {
    cells.persons.push_back("P" + std::to_string(p + 1));
  }
  return cells;
}

CellMeans MakeReachCells() { return *CalcCellMeans(MakeReachTable()); }

const WithinTest& FindTest(const WithinAnova& anova, size_t effect) {
  return *anova.effects.at(effect).test;
}

TEST(WithinAnova, AgreesWithROnOneFactor) {
  const Answer<WithinAnova> anova = CalcWithinAnova(MakeReachCells());
  ASSERT_TRUE(anova) << anova.reason();
  ASSERT_EQ(anova->effects.size(), 1u);
  const WithinEffect& size = anova->effects[0];
  EXPECT_EQ(size.name, "size");
  EXPECT_NEAR(size.ss_effect, 6140.844, 5e-4);
  EXPECT_NEAR(anova->ss_person, 300.7188, 5e-5);
  EXPECT_NEAR(size.ss_error, 239.9062, 5e-5);
  EXPECT_EQ(size.df_effect, 3.0);
  EXPECT_EQ(size.df_error, 21.0);
  const WithinTest& test = *size.test;
  EXPECT_NEAR(test.f, 179.17793, 5e-6);
  EXPECT_NEAR(test.p, 4.0718e-15, 5e-20);
  EXPECT_NEAR(test.greenhouse_geisser.epsilon, 0.4156420793, 5e-11);
  EXPECT_NEAR(test.greenhouse_geisser.p, 2.3802e-07, 5e-12);
  EXPECT_NEAR(test.huynh_feldt->epsilon, 0.4620955819, 5e-11);
  EXPECT_NEAR(test.huynh_feldt->p, 5.6771e-08, 5e-13);
  EXPECT_NEAR(test.mauchly->w, 0.0326821, 5e-8);
  EXPECT_NEAR(test.mauchly->p, 0.0017773, 5e-8);
  EXPECT_NEAR(test.partial_eta_squared, 0.9624016, 5e-8);
  EXPECT_NEAR(test.generalised_eta_squared, 0.9190859, 5e-8);
}

TEST(WithinAnova, AgreesWithRealGripsBySize) {
  // 11 people x 4 stick sizes (R 4 on the mocapGrip recordings, whose licence keeps the data out):
  // what follows from the printed F, epsilon and W.
  EXPECT_NEAR(*CalcHuynhFeldt(0.3786, 3, 11), 0.3946, 1e-4);
  EXPECT_NEAR(CalcFisherUpperP(358.71, 3 * 0.3786, 30 * 0.3786), 3.77e-10, 1e-12);
  EXPECT_NEAR(CalcFisherUpperP(358.71, 3 * 0.3946, 30 * 0.3946), 1.69e-10, 1e-12);
  EXPECT_NEAR(CalcMauchlyP(0.00879, 3, 4, 11), 1.09e-7, 1e-9);
  EXPECT_NEAR(358.71 * 3 / (358.71 * 3 + 30), 0.9729, 5e-5);
}

// Two conditions x three sizes, 7 people; made up. Answers: R 4.2, car 3.1 and afex 1.2.
CellMeans MakeTwoWayCells() {
  Eigen::MatrixXd means(7, 6);
  means << 12.1, 14.3, 15.2, 11.8, 13.9, 17.4,  //
      10.4, 12.9, 15.8, 11.0, 14.1, 16.9,       //
      13.3, 14.0, 16.1, 12.7, 15.5, 18.8,       //
      9.8, 13.1, 14.4, 10.9, 12.2, 15.0,        //
      11.6, 12.2, 16.6, 12.4, 14.9, 19.3,       //
      12.9, 15.1, 15.9, 12.0, 14.4, 16.2,       //
      10.9, 13.7, 14.1, 11.1, 15.0, 17.7;
  return MakeCells({{"condition", {"a", "b"}, {}, ""}, {"size", {"s", "m", "l"}, {}, ""}}, means);
}

TEST(WithinAnova, AgreesWithROnTwoFactors) {
  const Answer<WithinAnova> anova = CalcWithinAnova(MakeTwoWayCells());
  ASSERT_TRUE(anova) << anova.reason();
  EXPECT_NEAR(anova->ss_person, 23.549523810, 1e-9);
  const struct {
    const char* name;
    double ss_effect, ss_error, f, p, partial, generalised;
  } known[] = {{"condition", 8.41523809524, 6.65142857143, 7.59106529210, 3.30638371990e-02,
                0.558533501896, 0.161402867842},
               {"size", 157.97190476190, 8.41476190476, 112.63912625205, 1.67316921360e-08,
                0.949426465033, 0.783222644307},
               {"condition x size", 5.66619047619, 5.10714285714, 6.65678321678, 1.13492575715e-02,
                0.525945898161, 0.114725647676}};
  ASSERT_EQ(anova->effects.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const WithinEffect& effect = anova->effects[i];
    EXPECT_EQ(effect.name, known[i].name);
    EXPECT_NEAR(effect.ss_effect, known[i].ss_effect, 1e-9);
    EXPECT_NEAR(effect.ss_error, known[i].ss_error, 1e-9);
    EXPECT_NEAR(effect.test->f, known[i].f, 1e-9);
    EXPECT_NEAR(effect.test->p / known[i].p, 1.0, 1e-10);
    EXPECT_NEAR(effect.test->partial_eta_squared, known[i].partial, 1e-11);
    EXPECT_NEAR(effect.test->generalised_eta_squared, known[i].generalised, 1e-11);
  }
  const WithinTest& size = FindTest(*anova, 1);
  EXPECT_NEAR(size.mauchly->w, 0.674944054833, 1e-11);
  EXPECT_NEAR(size.mauchly->p, 0.374256576566, 1e-11);
  EXPECT_NEAR(size.greenhouse_geisser.epsilon, 0.754685116238, 1e-11);
  EXPECT_NEAR(size.greenhouse_geisser.p, 7.58648061641e-07, 1e-17);
  EXPECT_NEAR(size.huynh_feldt->epsilon, 0.953718305757, 1e-11);
  EXPECT_NEAR(size.huynh_feldt->p, 3.42969507919e-08, 1e-18);
  const WithinTest& both = FindTest(*anova, 2);
  EXPECT_NEAR(both.mauchly->p, 0.683972382418, 1e-11);
  EXPECT_NEAR(both.greenhouse_geisser.epsilon, 0.876458014559, 1e-11);
  EXPECT_EQ(both.huynh_feldt->epsilon, 1.0);  // 1.209 treated as 1
  EXPECT_NEAR(both.huynh_feldt->p, 1.13492575715e-02, 1e-13);
  EXPECT_EQ(FindTest(*anova, 0).mauchly.reason(), "two levels are always spherical");
}

TEST(WithinAnova, WithTwoLevelsIsThePairedTTest) {
  const Eigen::MatrixXd means = MakeReachMeans().leftCols(2);
  const auto anova = CalcWithinAnova(MakeCells({{"size", {"30", "45"}, {}, ""}}, means));
  const std::vector<double> a(means.col(0).begin(), means.col(0).end());
  const std::vector<double> b(means.col(1).begin(), means.col(1).end());
  const Answer<TTest> t = CalcPairedTTest(a, b);
  EXPECT_NEAR(FindTest(*anova, 0).f, t->t * t->t, 1e-10);
  EXPECT_NEAR(FindTest(*anova, 0).p, t->p, 1e-16);
}

TEST(WithinAnova, DoesNotCareAboutUnitOriginPersonsOrOrderOfLevels) {
  const CellMeans cells = MakeTwoWayCells();
  CellMeans changed = cells;
  changed.means = (cells.means.array() * 1e-3 + 1e4).matrix();
  changed.means = changed.means.colwise().reverse().eval();
  changed.means.col(0).swap(changed.means.col(2));
  changed.means.col(3).swap(changed.means.col(5));
  const Answer<WithinAnova> anova = CalcWithinAnova(changed);
  const WithinTest& test = FindTest(*anova, 2);
  EXPECT_NEAR(test.f, 6.65678321678, 1e-5);  // 1e4 leaves 12 digits of a spread of 1e-3
  EXPECT_NEAR(test.mauchly->w, 0.859044034753, 1e-5);
}

TEST(WithinAnova, SumsOfSquaresAddUp) {
  const CellMeans cells = MakeTwoWayCells();
  const Answer<WithinAnova> anova = CalcWithinAnova(cells);
  double sum = anova->ss_person;
  for (const WithinEffect& effect : anova->effects) sum += effect.ss_effect + effect.ss_error;
  EXPECT_NEAR(sum, (cells.means.array() - cells.means.mean()).square().sum(), 1e-10);
}

TEST(WithinAnova, GivesReasons) {
  const Factor size = {"size", {"30", "45", "60", "75"}, {}, ""};
  EXPECT_EQ(CalcWithinAnova(MakeCells({size}, MakeReachMeans().topRows(1))).reason(),
            "1 person; expected 2 or more");
  EXPECT_EQ(CalcWithinAnova(MakeCells({}, MakeReachMeans().leftCols(1))).reason(),
            "no factor: nothing to compare");
  EXPECT_EQ(
      CalcWithinAnova(MakeCells({{"size", {"30"}, {}, ""}}, MakeReachMeans().leftCols(1))).reason(),
      "factor \"size\" has one level: nothing to compare");

  // Every person reacts alike, up to rounding.
  Eigen::MatrixXd same = MakeReachMeans() * 0.1;
  for (Eigen::Index p = 1; p < same.rows(); ++p) {
    same.row(p) = same.row(0).array() + 0.1 * static_cast<double>(p);
  }
  const auto no_spread = CalcWithinAnova(MakeCells({size}, same));
  ASSERT_TRUE(no_spread);
  EXPECT_EQ(no_spread->effects[0].test.reason(),
            "the effect is the same in all 8 persons: no spread to test against");

  const auto few = CalcWithinAnova(MakeCells({size}, MakeReachMeans().topRows(3)));
  ASSERT_TRUE(few->effects[0].test);
  EXPECT_EQ(FindTest(*few, 0).mauchly.reason(),
            "3 persons are too few for 3 contrasts; expected 4 or more");
  EXPECT_GT(FindTest(*few, 0).f, 0.0);
  EXPECT_EQ(CalcHuynhFeldt(1.0, 3, 4).reason(), "4 persons are too few for 3 contrasts");
}

TEST(CellMeans, AveragesTrialsAndNamesWhoIsLeftOut) {
  MeasureTable table;
  table.factors = {{"condition", {"a", "b"}, {}, ""}, {"size", {"s", "l"}, {}, ""}};
  const auto add = [&](const char* person, const char* condition, const char* size, double value) {
    table.rows.push_back({person, "", {condition, size}, value});
  };
  for (const char* person : {"Q", "P"}) {
    add(person, "a", "s", 1.0);
    add(person, "a", "s", 2.0);
    add(person, "a", "s", std::nan(""));
    add(person, "a", "l", 3.0);
    add(person, "b", "s", 4.0);
  }
  add("Q", "b", "l", 5.0);
  add("P", "b", "l", std::nan(""));
  const Answer<CellMeans> cells = CalcCellMeans(table);
  ASSERT_TRUE(cells) << cells.reason();
  EXPECT_EQ(cells->cells, (std::vector<std::string>{"a, s", "a, l", "b, s", "b, l"}));
  EXPECT_EQ(cells->persons, (std::vector<std::string>{"Q"}));
  EXPECT_EQ(cells->means, (Eigen::MatrixXd(1, 4) << 1.5, 3, 4, 5).finished());
  ASSERT_EQ(cells->left_out.size(), 1u);
  EXPECT_EQ(cells->left_out[0].person, "P");
  EXPECT_EQ(cells->left_out[0].reason, "no value in b, l");
  EXPECT_EQ(cells->num_trials, 9);
  EXPECT_EQ(cells->num_missing, 3);
}

TEST(CellMeans, GivesReasons) {
  MeasureTable table = MakeReachTable();
  EXPECT_EQ(CalcCellMeans({}).reason(), "none of 0 persons has a value in every condition");
  table.rows[5].levels = {"31"};
  EXPECT_EQ(CalcCellMeans(table).reason(),
            "person \"P2\", trial \"2\": \"31\" is not a level of factor \"size\"");
  table.rows[5].levels = {};
  EXPECT_EQ(CalcCellMeans(table).reason(),
            "person \"P2\", trial \"2\" has 0 levels; expected one for each of 1 factors");
  table = MakeReachTable();
  table.rows[0].value = INFINITY;
  EXPECT_EQ(CalcCellMeans(table).reason(), "person \"P1\", trial \"1\": a value is infinite");
  table.factors[0].levels[1] = "30";
  EXPECT_EQ(CalcCellMeans(table).reason(), "factor \"size\" names the level \"30\" twice");
  table.factors[0].numbers.pop_back();
  table.factors[0].levels[1] = "45";
  EXPECT_EQ(CalcCellMeans(table).reason(), "factor \"size\" has 4 levels but 3 numbers");
  table.factors[0].levels.clear();
  EXPECT_EQ(CalcCellMeans(table).reason(), "factor \"size\" has no levels");
}

TEST(HalfWidths, AgreeWithR) {
  const CellMeans cells = MakeReachCells();
  const auto loftus = CalcHalfWidths(cells, BarKind::kLoftusMasson);
  ASSERT_TRUE(loftus) << loftus.reason();
  EXPECT_NEAR((*loftus)(0), 2.485128, 5e-7);
  EXPECT_EQ((*loftus)(0), (*loftus)(3));
  const Eigen::Vector4d morey(3.39578, 1.039538, 1.512325, 4.127901);
  const auto corrected = CalcHalfWidths(cells, BarKind::kCousineauMorey);
  EXPECT_LT((*corrected - morey).cwiseAbs().maxCoeff(), 5e-6);
  const auto uncorrected = CalcHalfWidths(cells, BarKind::kCousineau);
  EXPECT_LT((*corrected * std::sqrt(0.75) - *uncorrected).norm(), 1e-12);
  // Between persons: half the one-sample t interval.
  const auto between = CalcHalfWidths(cells, BarKind::kBetweenPerson);
  const Eigen::MatrixXd y = cells.means;
  const Answer<TTest> first = CalcTTest({y.col(0).begin(), y.col(0).end()});
  EXPECT_NEAR((*between)(0), (first->interval.high - first->interval.low) / 2.0, 1e-12);
}

TEST(HalfWidths, WithinPersonBarsIgnoreWhatPersonsDifferIn) {
  CellMeans cells = MakeReachCells();
  CellMeans shifted = cells;
  for (Eigen::Index p = 0; p < shifted.means.rows(); ++p) {
    shifted.means.row(p).array() += 17.0 * static_cast<double>(p * p);
  }
  for (BarKind kind : ListBarKinds()) {
    const auto before = CalcHalfWidths(cells, kind), after = CalcHalfWidths(shifted, kind);
    const bool is_same = (*before - *after).cwiseAbs().maxCoeff() < 1e-9;
    EXPECT_EQ(is_same, kind != BarKind::kBetweenPerson) << NameOf(kind);
  }
}

TEST(HalfWidths, GiveReasons) {
  const CellMeans one_person =
      MakeCells({{"size", {"30", "45", "60", "75"}, {}, ""}}, MakeReachMeans().topRows(1));
  const CellMeans one_cell = MakeCells({{"size", {"30"}, {}, ""}}, MakeReachMeans().leftCols(1));
  for (BarKind kind : ListBarKinds()) {
    EXPECT_EQ(CalcHalfWidths(one_person, kind).reason(), "1 person; expected 2 or more");
    EXPECT_EQ(CalcHalfWidths(one_cell, kind).has_value(), kind == BarKind::kBetweenPerson);
  }
}

TEST(Pairs, SpreadOfAllDifferencesIsTheAnovaError) {
  // The mean over pairs of s_d^2 / 2 equals MS_error: the pooled bar and the pairs tell one story.
  const CellMeans cells = MakeReachCells();
  const std::vector<PairComparison> pairs = ComparePairs(cells);
  ASSERT_EQ(pairs.size(), 6u);
  double sum = 0.0;
  std::vector<double> p;
  for (const PairComparison& pair : pairs) {
    sum += pair.test->standard_deviation * pair.test->standard_deviation / 2.0;
    p.push_back(pair.test->p);
  }
  const WithinEffect& size = CalcWithinAnova(cells)->effects[0];
  EXPECT_NEAR(sum / 6.0, size.ss_error / size.df_error, 1e-10);
  EXPECT_NEAR(pairs[0].test->p, 7.15227618397e-06, 1e-16);  // R: t.test(45 mm, 30 mm, paired)
  EXPECT_NEAR(pairs[2].test->t, 13.67523, 5e-6);            // 75 against 30
  const std::vector<double> holm = AdjustHolm(p);
  for (size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(pairs[i].p_holm, holm[i]);
}

// Data and certified values: NIST StRD, analysis of variance.

void ExpectCertified(const Answer<OneWayAnova>& anova, double ss_between, double ss_within,
                     double f, double relative_error) {
  ASSERT_TRUE(anova) << anova.reason();
  EXPECT_NEAR(anova->ss_between / ss_between, 1.0, relative_error);
  EXPECT_NEAR(anova->ss_within / ss_within, 1.0, relative_error);
  EXPECT_NEAR(anova->f / f, 1.0, relative_error);
}

/** Groups of a table of NIST's. */
std::vector<std::vector<double>> ReadGroups(const std::string& name) {
  std::vector<std::vector<double>> groups;
  for (const std::vector<std::string>& row : ReadKnownRows(name)) {
    groups.resize(std::stoul(row[0]) + 1);
    groups.back().push_back(std::stod(row[1]));
  }
  return groups;
}

TEST(OneWayAnova, AgreesWithNistSiRstvAndAtmWtAg) {
  const auto anova = CalcOneWayAnova(ReadGroups("nist_sirstv.csv"));
  ExpectCertified(anova, 5.11462616000000e-02, 2.16636560000000e-01, 1.18046237440255, 1e-12);
  EXPECT_EQ(anova->df_between, 4.0);
  EXPECT_EQ(anova->df_within, 20.0);
  ExpectCertified(CalcOneWayAnova(ReadGroups("nist_atmwtag.csv")), 3.63834187500000e-09,
                  1.04951729166667e-08, 1.59467335677930e+01, 1e-9);
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
