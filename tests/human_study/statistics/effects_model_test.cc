// 32 random designs with factors within and between persons, unequal groups and trials, missing
// conditions and sessions, factors of up to five levels, against R: afex, lme4 and lmerTest
// (r/make_designs.R).
#include "human_study/statistics/effects_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "human_study/statistics/within_anova.h"
#include "tests/human_study/statistics/known_studies.h"

namespace graspbench {
namespace {

constexpr int kNumDesigns = 32;

void AddLevel(const std::string& level, Factor& factor) {
  auto& levels = factor.levels;
  if (std::find(levels.begin(), levels.end(), level) == levels.end()) levels.push_back(level);
  std::sort(levels.begin(), levels.end());
}

/** Columns: design, person, a, b, g, h, session, value; empty where the design has no such. */
std::map<int, MeasureTable> ReadDesigns() {
  std::map<int, MeasureTable> tables;
  for (const std::vector<std::string>& cells : ReadKnownRows("trials.csv")) {
    MeasureTable& table = tables[std::stoi(cells[0])];
    if (table.rows.empty()) {
      if (!cells[2].empty()) table.factors.push_back({"a", {}, {}, ""});
      if (!cells[3].empty()) table.factors.push_back({"b", {}, {}, ""});
      if (!cells[4].empty()) table.groups.push_back({"g", {}, {}, ""});
      if (!cells[5].empty()) table.groups.push_back({"h", {}, {}, ""});
    }
    Observation row = {cells[1], "", {}, std::stod(cells[7])};
    for (size_t i = 0; i < table.factors.size(); ++i) row.levels.push_back(cells[2 + i]);
    for (size_t i = 0; i < table.groups.size(); ++i) row.groups.push_back(cells[4 + i]);
    row.session = cells[6];
    for (size_t i = 0; i < row.levels.size(); ++i) AddLevel(row.levels[i], table.factors[i]);
    for (size_t i = 0; i < row.groups.size(); ++i) AddLevel(row.groups[i], table.groups[i]);
    table.rows.push_back(row);
  }
  return tables;
}

/** By analysis, effect and quantity. */
using Expected = std::map<std::string, double>;

std::map<int, Expected> ReadExpected() {
  std::map<int, Expected> designs;
  for (const std::vector<std::string>& cells : ReadKnownRows("expected.csv")) {
    designs[std::stoi(cells[0])][cells[1] + "|" + cells[2] + "|" + cells[3]] = std::stod(cells[4]);
  }
  return designs;
}

class Comparison {
 public:
  Comparison(int design, Expected expected, std::string analysis)
      : design_(design), expected_(std::move(expected)), analysis_(std::move(analysis)) {}

  bool Has(const std::string& effect, const std::string& quantity) const {
    return expected_.count(Key(effect, quantity)) > 0;
  }
  void Check(const std::string& effect, const std::string& quantity, double value,
             double tolerance) {
    const std::string key = Key(effect, quantity);
    ASSERT_EQ(expected_.count(key), 1u) << "design " << design_ << " has no " << key;
    const double expected = expected_.at(key);
    EXPECT_NEAR(value, expected, tolerance * std::max(std::abs(expected), 1e-12))
        << "design " << design_ << ", " << key;
    expected_.erase(key);
  }
  /** Everything that R said of this analysis was asked for. */
  void CheckNothingLeft() const {
    for (const auto& [key, value] : expected_) {
      EXPECT_NE(key.substr(0, analysis_.size()), analysis_) << "design " << design_ << ": " << key;
    }
  }

 private:
  std::string Key(const std::string& effect, const std::string& quantity) const {
    return analysis_ + "|" + effect + "|" + quantity;
  }
  int design_;
  Expected expected_;
  std::string analysis_;
};

TEST(MixedDesigns, AnovaAgreesWithAfexOnAllDesigns) {
  const std::map<int, MeasureTable> tables = ReadDesigns();
  const std::map<int, Expected> expected = ReadExpected();
  ASSERT_EQ(tables.size(), static_cast<size_t>(kNumDesigns));
  for (const auto& [design, table] : tables) {
    Comparison compare(design, expected.at(design), "anova");
    const Answer<CellMeans> cells = CalcCellMeans(table);
    ASSERT_TRUE(cells) << cells.reason();
    const Answer<WithinAnova> anova = CalcWithinAnova(*cells);
    ASSERT_TRUE(anova) << "design " << design << ": " << anova.reason();
    compare.Check("", "persons", anova->num_persons, 0.0);
    for (const WithinEffect& effect : anova->effects) {
      ASSERT_TRUE(effect.test) << effect.test.reason();
      const WithinTest& test = *effect.test;
      compare.Check(effect.name, "f", test.f, 1e-9);
      compare.Check(effect.name, "df_1", effect.df_effect, 0.0);
      compare.Check(effect.name, "df_2", effect.df_error, 0.0);
      compare.Check(effect.name, "p", test.p, 1e-8);
      compare.Check(effect.name, "ges", test.generalised_eta_squared, 1e-9);
      if (!compare.Has(effect.name, "gg")) continue;
      compare.Check(effect.name, "gg", test.greenhouse_geisser.epsilon, 1e-9);
      compare.Check(effect.name, "p_gg", test.greenhouse_geisser.p, 1e-8);
      if (test.huynh_feldt) compare.Check(effect.name, "hf", test.huynh_feldt->epsilon, 1e-9);
      if (!compare.Has(effect.name, "mauchly_w")) continue;
      ASSERT_TRUE(test.mauchly) << test.mauchly.reason();
      compare.Check(effect.name, "mauchly_w", test.mauchly->w, 1e-8);
      compare.Check(effect.name, "mauchly_p", test.mauchly->p, 1e-7);
    }
    compare.CheckNothingLeft();
  }
}

TEST(MixedDesigns, ModelAgreesWithLme4OnAllDesigns) {
  const std::map<int, Expected> expected = ReadExpected();
  int num_correlated = 0, num_fallen = 0;
  for (const auto& [design, table] : ReadDesigns()) {
    Comparison compare(design, expected.at(design), "model");
    const Answer<EffectsModel> model = FitEffectsModel(table);
    ASSERT_TRUE(model) << "design " << design << ": " << model.reason();
    compare.Check("", "correlated", model->is_correlated ? 1.0 : 0.0, 0.0);
    compare.Check("", "reml", model->reml_criterion, 1e-10);
    compare.Check("", "sigma", model->residual_sd, 1e-6);
    for (const RandomPart& part : model->random) compare.Check(part.name, "sd", part.sd, 1e-5);
    for (const EffectTest& effect : model->effects) {
      ASSERT_TRUE(effect.test) << effect.test.reason();
      compare.Check(effect.name, "f", effect.test->f, 1e-6);
      compare.Check(effect.name, "df_2", effect.test->df_2, 1e-4);
    }
    for (const CellEstimate& cell : model->cells) {
      std::string name = cell.cell;
      const size_t comma = name.find(", ");
      if (comma != std::string::npos) name.replace(comma, 2, "/");
      compare.Check(name, "mean", cell.estimate, 1e-6);
      compare.Check(name, "se", cell.standard_error, 1e-6);
      compare.Check(name, "df", cell.test->df, 1e-4);
    }
    compare.CheckNothingLeft();
    num_correlated += model->is_correlated;
    num_fallen += !model->fallbacks.empty();
  }
  // The designs ask every rung of the ladder.
  EXPECT_GE(num_correlated, 4);
  EXPECT_GE(num_fallen, 4);
}

/** Two groups of persons, three sizes, two trials each. */
MeasureTable MakeGroups(int num_first, int num_second) {
  MeasureTable table;
  table.factors = {{"size", {"30", "60", "90"}, {0.03, 0.06, 0.09}, ""}};
  table.groups = {{"group", {"patient", "control"}, {}, ""}};
  for (int person = 0; person < num_first + num_second; ++person) {
    const bool is_first = person < num_first;
    for (int size = 0; size < 3; ++size) {
      for (int trial = 0; trial < 2; ++trial) {
        const double odd = ((person * 7 + size * 5 + trial * 3) % 11) / 10.0;
        table.rows.push_back({"P" + std::to_string(person),
                              "",
                              {table.factors[0].levels[static_cast<size_t>(size)]},
                              (is_first ? 2.0 : 0.0) + 3.0 * (person % 3) + size + odd,
                              {is_first ? "patient" : "control"}});
      }
    }
  }
  return table;
}

TEST(EffectsModel, KeepsAPersonWithAnEmptyCondition) {
  MeasureTable table = MakeGroups(4, 4);
  const auto is_gone = [](const Observation& row) {
    return row.person == "P1" && row.levels[0] == "60";
  };
  table.rows.erase(std::remove_if(table.rows.begin(), table.rows.end(), is_gone), table.rows.end());
  EXPECT_EQ(CalcWithinAnova(*CalcCellMeans(table))->num_persons, 7);
  const Answer<EffectsModel> model = FitEffectsModel(table);
  ASSERT_TRUE(model) << model.reason();
  EXPECT_EQ(model->num_persons, 8);
  EXPECT_EQ(model->num_observations, 46);
}

TEST(EffectsModel, AQuantityIsOneSlopeForEachGroup) {
  MeasureTable table = MakeGroups(5, 4);
  for (Observation& row : table.rows) {
    if (row.groups[0] == "patient") row.value += 50.0 * std::stod(row.levels[0]) / 30.0;
  }
  const Answer<EffectsModel> model = FitQuantityModel(table, 0);
  ASSERT_TRUE(model) << model.reason();
  ASSERT_EQ(model->effects.size(), 3u);
  EXPECT_EQ(model->effects[2].name, "size x group");
  EXPECT_EQ(model->effects[2].test->df_1, 1.0);
  EXPECT_LT(model->effects[2].test->p, 1e-6);
}

/** A table of points over one quantity. */
MeasureTable MakeQuantityTable(const std::vector<PersonPoint>& points) {
  MeasureTable table;
  table.factors = {{"day", {}, {}, ""}};
  for (int day = 0; day < 10; ++day) {
    table.factors[0].levels.push_back(std::to_string(day));
    table.factors[0].numbers.push_back(day);
  }
  for (const PersonPoint& point : points) {
    table.rows.push_back({point.person, "", {std::to_string(std::lround(point.x))}, point.y});
  }
  return table;
}

// R 4.2, lme4 1.1-31, lmerTest 3.1-3: y ~ x + (x | person), REML, on the sleep study.
TEST(EffectsModel, TheSlopeIsLme4sAndIsTestedAgainstTheReference) {
  const MeasureTable table = MakeQuantityTable(MakeSleepStudy());
  const Answer<EffectsModel> model = FitQuantityModel(table, 0, 10.0);
  ASSERT_TRUE(model) << model.reason();
  EXPECT_TRUE(model->is_correlated);
  ASSERT_TRUE(model->slope) << model->slope.reason();
  EXPECT_NEAR(model->slope->estimate, 10.4672859596, 1e-9);
  EXPECT_NEAR(model->slope->standard_error, 1.54578893243, 1e-5);
  EXPECT_NEAR(model->random[1].sd, 5.9221333, 1e-4);
  EXPECT_NEAR(model->residual_sd, 25.5918159, 1e-4);
  ASSERT_TRUE(model->slope->test) << model->slope->test.reason();
  EXPECT_NEAR(model->slope->test->df, 17.0, 1e-4);
  EXPECT_NEAR(model->slope->t, (10.4672859596 - 10.0) / 1.54578893243, 1e-5);
  EXPECT_NEAR(model->slope->test->p, 0.7660936, 1e-5);  // 2 pt(-0.302296, 17)
  const Answer<EffectsModel> against_zero = FitQuantityModel(table, 0);
  EXPECT_NEAR(against_zero->slope->t, 6.77148460569, 1e-4);
  EXPECT_NEAR(against_zero->slope->test->p / 3.26379e-06, 1.0, 1e-3);
}

TEST(EffectsModel, TheSlopeIsLme4sWhenPersonsHaveDifferentNumbersOfTrials) {
  std::vector<PersonPoint> kept;
  const std::vector<PersonPoint> all = MakeSleepStudy();
  for (size_t i = 0; i < all.size(); ++i) {
    const size_t person = i / 10 + 1, day = i % 10;
    if ((person % 3 == 1 && day > 6) || (person % 4 == 2 && day < 4)) continue;
    kept.push_back(all[i]);
  }
  const Answer<EffectsModel> model = FitQuantityModel(MakeQuantityTable(kept), 0);
  ASSERT_TRUE(model) << model.reason();
  EXPECT_EQ(model->num_observations, 142);
  EXPECT_NEAR(model->slope->estimate, 9.45481611, 1e-5);
  EXPECT_NEAR(model->slope->standard_error, 2.09214435, 1e-5);
  EXPECT_NEAR(model->slope->test->df, 14.56317, 1e-3);
}

TEST(EffectsModel, AHugeValueEndsInWords) {
  MeasureTable table = MakeGroups(4, 4);
  table.rows[5].value = 1e300;
  const std::string reason =
      "a value is 1e+300; no measurement is larger than 1e+100, so correct it";
  EXPECT_EQ(FitEffectsModel(table).reason(), "person \"P0\": " + reason);
  EXPECT_EQ(FitQuantityModel(table, 0).reason(), "person \"P0\": " + reason);
  EXPECT_EQ(CalcCellMeans(table).reason(), "person \"P0\", trial \"\": " + reason);
}

TEST(EffectsModel, GivesReasons) {
  const auto reason = [](const MeasureTable& table) { return FitEffectsModel(table).reason(); };
  EXPECT_EQ(reason(MakeGroups(1, 4)), "group \"patient\" has 1 person; expected 2 or more");
  EXPECT_EQ(CalcWithinAnova(*CalcCellMeans(MakeGroups(1, 4))).reason(),
            "group \"patient\" has 1 person with a value in every condition; expected 2 or more");
  EXPECT_EQ(reason(MakeGroups(0, 4)), "group \"patient\" has 0 persons; expected 2 or more");
  MeasureTable table = MakeGroups(4, 4);
  table.groups[0].levels = {"patient"};
  EXPECT_EQ(reason(table),
            "person \"P4\", trial \"\": \"control\" is not a level of factor "
            "\"group\"");
  table = MakeGroups(4, 0);
  table.groups[0].levels = {"patient"};
  EXPECT_EQ(reason(table), "factor \"group\" has one level: nothing to compare");
  table = MakeGroups(4, 4);
  table.rows[3].groups = {"control"};
  EXPECT_EQ(reason(table), "person \"P0\" is in two groups");
  EXPECT_EQ(CalcCellMeans(table).reason(),
            "person \"P0\", trial \"\" is in another group than the person's other trials");
  table = MakeGroups(4, 4);
  for (Observation& row : table.rows) {
    if (row.groups[0] == "control" && row.levels[0] == "90") row.value = NAN;
  }
  EXPECT_EQ(reason(table), "nobody has a value in 90, control");
  table = MakeGroups(4, 4);
  for (Observation& row : table.rows) row.value = 1.0;
  EXPECT_EQ(reason(table), "the effects explain every trial: no residual to compare with");
  for (Observation& row : table.rows) row.value = NAN;
  EXPECT_EQ(reason(table), "no trial has a value");
}

TEST(EffectsModel, PersonsWhoDoNotDifferHaveNoModel) {
  // Persons' means are equal: the variance between them is estimated as zero.
  MeasureTable table;
  table.factors = {{"side", {"left", "right"}, {}, ""}};
  for (int person = 0; person < 6; ++person) {
    for (const char* side : {"left", "right"}) {
      for (const double value : {-1.0, 0.5, 0.5}) {
        table.rows.push_back({std::to_string(person), "", {side}, value});
      }
    }
  }
  EXPECT_EQ(FitEffectsModel(table).reason().substr(0, 55),
            "persons do not differ by more than their trials do (eve");
}

}  // namespace
}  // namespace graspbench
