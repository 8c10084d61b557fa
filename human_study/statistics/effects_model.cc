#include "human_study/statistics/effects_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <unsupported/Eigen/KroneckerProduct>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;

constexpr double kZeroTheta = 1e-4;  // as lme4's isSingular
constexpr Index kMaxColumns = 64;    // of the fixed effects
constexpr Index kMaxCorrelated = 6;  // of the persons' own effects: 21 parameters

/** A factor as columns of the design. */
struct Variable {
  Factor factor;
  bool is_within = true;
  MatrixXd coding;  // (num_levels x num_columns)
};

/** A trial with a value: its level of each variable. */
struct CodedTrial {
  std::string person, session;
  std::vector<size_t> levels;
  double value = 0.0;
};

struct ModelData {
  std::vector<Variable> variables;
  std::vector<CodedTrial> trials;
  std::vector<std::string> persons;
  bool is_quantity = false;
  double scale = 1.0;  // of the quantity: what one unit of its coding is
};

MatrixXd CodeLevels(Index num_levels) {
  MatrixXd coding = MatrixXd::Zero(num_levels, num_levels - 1);
  coding.topRows(num_levels - 1).setIdentity();
  coding.row(num_levels - 1).setConstant(-1.0);
  return coding;
}

/** All sets of variables, small ones first; the empty set is the constant. */
std::vector<std::vector<size_t>> ListSets(size_t num_variables) {
  std::vector<std::vector<size_t>> sets;
  for (size_t bits = 0; bits < (size_t{1} << num_variables); ++bits) {
    std::vector<size_t> set;
    for (size_t i = 0; i < num_variables; ++i) {
      if (bits & (size_t{1} << i)) set.push_back(i);
    }
    sets.push_back(set);
  }
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return sets;
}

/** The columns of a set of variables at their levels; a level of -1 is the mean of all levels. */
RowVectorXd MakeRow(const std::vector<Variable>& variables, const std::vector<size_t>& set,
                    const std::vector<int>& levels) {
  RowVectorXd row = RowVectorXd::Ones(1);
  for (const size_t i : set) {
    const MatrixXd& coding = variables[i].coding;
    const RowVectorXd own =
        levels[i] < 0 ? RowVectorXd(coding.colwise().mean()) : RowVectorXd(coding.row(levels[i]));
    row = RowVectorXd(Eigen::kroneckerProduct(row, own).eval());
  }
  return row;
}

RowVectorXd MakeFullRow(const std::vector<Variable>& variables, const std::vector<int>& levels) {
  std::vector<double> row;
  for (const std::vector<size_t>& set : ListSets(variables.size())) {
    const RowVectorXd own = MakeRow(variables, set, levels);
    row.insert(row.end(), own.begin(), own.end());
  }
  return Eigen::Map<RowVectorXd>(row.data(), static_cast<Index>(row.size()));
}

/** Empty when the variables can be compared. */
std::string FindFault(const ModelData& data) {
  if (data.variables.empty()) return "no factor: nothing to compare";
  Index num_columns = 1;
  for (const Variable& variable : data.variables) {
    if (variable.factor.levels.size() < 2) {
      return "factor \"" + variable.factor.name + "\" has one level: nothing to compare";
    }
    num_columns *= 1 + variable.coding.cols();
    if (num_columns > kMaxColumns) {
      return "more than " + std::to_string(kMaxColumns) + " conditions";
    }
  }
  if (data.persons.size() < 2) {
    return FormatCount(data.persons.size(), "person") + "; expected 2 or more";
  }
  return "";
}

/** Names a combination of levels that no trial has, or of groups with fewer than two persons. */
std::string FindEmpty(const ModelData& data) {
  std::vector<Factor> factors, groups;
  for (const Variable& variable : data.variables) {
    factors.push_back(variable.factor);
    if (!variable.is_within) groups.push_back(variable.factor);
  }
  const std::vector<std::string> cells = ListCells(factors), group_cells = ListCells(groups);
  std::vector<int> counts(cells.size(), 0);
  std::vector<std::set<std::string>> members(group_cells.size());
  for (const CodedTrial& trial : data.trials) {
    size_t cell = 0, group = 0;
    for (size_t i = 0; i < data.variables.size(); ++i) {
      const size_t num_levels = data.variables[i].factor.levels.size();
      cell = cell * num_levels + trial.levels[i];
      if (!data.variables[i].is_within) group = group * num_levels + trial.levels[i];
    }
    ++counts[cell];
    members[group].insert(trial.person);
  }
  for (size_t i = 0; i < members.size(); ++i) {
    if (!groups.empty() && members[i].size() < 2) {
      return "group \"" + group_cells[i] + "\" has " + FormatCount(members[i].size(), "person") +
             "; expected 2 or more";
    }
  }
  for (size_t i = 0; i < cells.size(); ++i) {
    if (!data.is_quantity && counts[i] == 0) return "nobody has a value in " + cells[i];
  }
  return "";
}

/** The parts that a rung of the ladder has. */
struct Rung {
  bool is_correlated = false;
  std::vector<size_t> own;  // correlated: columns of OwnColumns; else parts of OwnParts
  bool has_sessions = false;
};

/** What varies between persons where nothing correlates: their level, then every variable within
persons. */
struct OwnParts {
  std::vector<std::string> names = {"level of persons"};
  std::vector<size_t> variables = {0};  // the level has none
};

OwnParts ListOwnParts(const ModelData& data) {
  OwnParts parts;
  for (size_t i = 0; i < data.variables.size(); ++i) {
    if (!data.variables[i].is_within) continue;
    const std::string& name = data.variables[i].factor.name;
    parts.names.push_back(data.is_quantity ? "slope over " + name : "persons x " + name);
    parts.variables.push_back(i);
  }
  return parts;
}

/** Columns of Z of one part: the level, a quantity, or one column for each level of a factor. */
int CountColumns(const ModelData& data, const OwnParts& parts, size_t part) {
  if (part == 0 || data.is_quantity) return 1;
  return static_cast<int>(data.variables[parts.variables[part]].factor.levels.size());
}

double FindOfPart(const ModelData& data, const OwnParts& parts, size_t part, int column,
                  const CodedTrial& trial) {
  if (part == 0) return 1.0;
  const size_t variable = parts.variables[part];
  const size_t level = trial.levels[variable];
  if (data.is_quantity) return data.variables[variable].coding(static_cast<Index>(level), 0);
  return level == static_cast<size_t>(column) ? 1.0 : 0.0;
}

/** The persons' own columns: their level, then every column of every variable within persons. */
struct OwnColumns {
  std::vector<std::string> names = {"level of persons"};
  std::vector<std::pair<size_t, Index>> columns = {{0, -1}};  // variable and column of its coding
};

OwnColumns ListOwnColumns(const ModelData& data) {
  OwnColumns own;
  for (size_t i = 0; i < data.variables.size(); ++i) {
    const Variable& variable = data.variables[i];
    if (!variable.is_within) continue;
    for (Index column = 0; column < variable.coding.cols(); ++column) {
      own.columns.push_back({i, column});
      own.names.push_back(data.is_quantity
                              ? "slope over " + variable.factor.name
                              : variable.factor.name + ": " +
                                    variable.factor.levels[static_cast<size_t>(column)]);
    }
  }
  return own;
}

double FindOwn(const ModelData& data, const OwnColumns& own, size_t column,
               const CodedTrial& trial) {
  const auto [variable, coded] = own.columns[column];
  if (coded < 0) return 1.0;
  return data.variables[variable].coding(static_cast<Index>(trial.levels[variable]), coded);
}

/** The person's own columns of Z for one trial. */
std::vector<double> MakeOwnRow(const ModelData& data, const Rung& rung, const CodedTrial& trial) {
  std::vector<double> row;
  const OwnColumns columns = ListOwnColumns(data);
  const OwnParts parts = ListOwnParts(data);
  for (const size_t i : rung.own) {
    if (rung.is_correlated) {
      row.push_back(FindOwn(data, columns, i, trial));
      continue;
    }
    for (int column = 0; column < CountColumns(data, parts, i); ++column) {
      row.push_back(FindOfPart(data, parts, i, column, trial));
    }
  }
  return row;
}

std::vector<RemlGroup> MakeGroups(const ModelData& data, const Rung& rung) {
  std::map<std::string, std::vector<const CodedTrial*>> by_person;
  for (const CodedTrial& trial : data.trials) by_person[trial.person].push_back(&trial);
  std::vector<RemlGroup> groups;
  for (const std::string& person : data.persons) {
    const auto& trials = by_person.at(person);
    std::vector<std::string> sessions;
    for (const CodedTrial* trial : trials) {
      if (std::find(sessions.begin(), sessions.end(), trial->session) == sessions.end()) {
        sessions.push_back(trial->session);
      }
    }
    const auto num_own = static_cast<Index>(MakeOwnRow(data, rung, *trials.front()).size());
    const auto num_rows = static_cast<Index>(trials.size());
    RemlGroup group;
    group.y.resize(num_rows);
    group.z = MatrixXd::Zero(
        num_rows, num_own + (rung.has_sessions ? static_cast<Index>(sessions.size()) : 0));
    for (Index row = 0; row < num_rows; ++row) {
      const CodedTrial& trial = *trials[static_cast<size_t>(row)];
      const std::vector<int> levels(trial.levels.begin(), trial.levels.end());
      const RowVectorXd x = MakeFullRow(data.variables, levels);
      if (row == 0) group.x.resize(num_rows, x.size());
      group.x.row(row) = x;
      group.y(row) = trial.value;
      const std::vector<double> own = MakeOwnRow(data, rung, trial);
      for (Index i = 0; i < num_own; ++i) group.z(row, i) = own[static_cast<size_t>(i)];
      if (!rung.has_sessions) continue;
      const auto session = std::find(sessions.begin(), sessions.end(), trial.session);
      group.z(row, num_own + (session - sessions.begin())) = 1.0;
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

struct RungFit {
  Rung rung;
  RemlFit fit;
};

Answer<RemlFit> FitRung(const ModelData& data, const Rung& rung) {
  RemlStructure structure;
  if (rung.is_correlated) {
    structure.num_correlated = static_cast<int>(rung.own.size());
  } else {
    const OwnParts parts = ListOwnParts(data);
    for (const size_t part : rung.own) structure.blocks.push_back(CountColumns(data, parts, part));
  }
  structure.has_shared = rung.has_sessions;
  return FitReml(MakeGroups(data, rung), structure);
}

/** A person with two sessions, so that sessions are not persons by another name. */
bool HasSessions(const ModelData& data) {
  std::map<std::string, std::set<std::string>> sessions;
  for (const CodedTrial& trial : data.trials) sessions[trial.person].insert(trial.session);
  return std::any_of(sessions.begin(), sessions.end(),
                     [](const auto& entry) { return entry.second.size() > 1; });
}

/** Takes the parts without variance off the rung and says so. */
void DropZeros(const OwnParts& parts, const RemlFit& fit, Rung& rung,
               std::vector<std::string>& fallbacks) {
  std::string dropped;
  const auto drop = [&](const std::string& name) {
    dropped += (dropped.empty() ? "" : ", ") + name;
  };
  std::vector<size_t> kept;
  for (size_t i = 0; i < rung.own.size(); ++i) {
    if (std::abs(fit.theta(static_cast<Index>(i))) < kZeroTheta) {
      drop(parts.names[rung.own[i]]);
    } else {
      kept.push_back(rung.own[i]);
    }
  }
  rung.own = kept;
  if (rung.has_sessions && std::abs(fit.theta(fit.theta.size() - 1)) < kZeroTheta) {
    drop("level of sessions");
    rung.has_sessions = false;
  }
  fallbacks.push_back("variance zero, left out: " + dropped);
}

Answer<RungFit> Descend(const ModelData& data, const OwnColumns& own,
                        std::vector<std::string>& fallbacks) {
  Rung rung;
  rung.own.resize(own.columns.size());
  std::iota(rung.own.begin(), rung.own.end(), size_t{0});
  rung.has_sessions = HasSessions(data);
  if (rung.own.size() > 1) {
    rung.is_correlated = true;
    if (data.persons.size() <= rung.own.size()) {
      fallbacks.push_back("correlations left out: " + FormatCount(data.persons.size(), "person") +
                          " for " + FormatCount(rung.own.size(), "effect") + " of each");
    } else if (static_cast<Index>(rung.own.size()) > kMaxCorrelated) {
      fallbacks.push_back("correlations left out: more than " + std::to_string(kMaxCorrelated) +
                          " effects of each person");
    } else {
      const Answer<RemlFit> fit = FitRung(data, rung);
      if (fit && !fit->is_singular) return RungFit{rung, *fit};
      fallbacks.push_back("correlations left out: " +
                          (fit ? std::string("with them the fit is singular") : fit.reason()));
    }
    rung.is_correlated = false;
  }
  const OwnParts parts = ListOwnParts(data);
  rung.own.resize(parts.names.size());
  std::iota(rung.own.begin(), rung.own.end(), size_t{0});
  while (!rung.own.empty() || rung.has_sessions) {
    const Answer<RemlFit> fit = FitRung(data, rung);
    if (fit && !fit->is_singular) return RungFit{rung, *fit};
    if (fit) {
      DropZeros(parts, *fit, rung, fallbacks);
    } else if (rung.own.size() > 1) {
      fallbacks.push_back("persons' own effects left out: " + fit.reason());
      rung.own = {0};
    } else if (rung.has_sessions && !rung.own.empty()) {
      fallbacks.push_back("level of sessions left out: " + fit.reason());
      rung.has_sessions = false;
    } else {
      return fit.none();
    }
  }
  return NoAnswer{
      "persons do not differ by more than their trials do (every variance between persons is "
      "zero): trials of one person cannot be told from those of another"};
}

std::vector<RandomPart> ListRandom(const ModelData& data, const RungFit& rung) {
  std::vector<RandomPart> parts;
  const std::vector<std::string> names =
      rung.rung.is_correlated ? ListOwnColumns(data).names : ListOwnParts(data).names;
  const auto num_own = static_cast<int>(rung.rung.own.size());
  const MatrixXd psi = rung.fit.CalcCovariance(rung.rung.is_correlated ? num_own : 0);
  for (Index i = 0; i < num_own; ++i) {
    const double sd = rung.rung.is_correlated ? std::sqrt(psi(i, i))
                                              : rung.fit.sigma * std::abs(rung.fit.theta(i));
    const size_t own = rung.rung.own[static_cast<size_t>(i)];
    parts.push_back({names[own], own > 0 ? sd / data.scale : sd});
  }
  if (rung.rung.has_sessions) {
    parts.push_back({"level of sessions",
                     rung.fit.sigma * std::abs(rung.fit.theta(rung.fit.theta.size() - 1))});
  }
  return parts;
}

Answer<CoefficientTest> TestCoefficient(const RemlFit& fit, const Eigen::VectorXd& contrast,
                                        double estimate, double standard_error, double reference) {
  const Answer<double> df = fit.CalcDf(contrast);
  if (!df) return df.none();
  const double half = CalcStudentQuantile(0.975, *df) * standard_error;
  return CoefficientTest{*df,
                         CalcStudentTwoSidedP((estimate - reference) / standard_error, *df),
                         {estimate - half, estimate + half}};
}

/** Of the first variable, at the mean of the groups. */
SlopeEstimate EstimateSlope(const ModelData& data, const RemlFit& fit, double reference) {
  Eigen::VectorXd contrast = Eigen::VectorXd::Zero(fit.beta.size());
  contrast(1) = 1.0 / data.scale;
  SlopeEstimate slope;
  slope.estimate = contrast.dot(fit.beta);
  slope.standard_error = std::sqrt(contrast.dot(fit.covariance * contrast));
  slope.reference = reference;
  slope.t = (slope.estimate - reference) / slope.standard_error;
  slope.test = TestCoefficient(fit, contrast, slope.estimate, slope.standard_error, reference);
  return slope;
}

std::vector<EffectTest> TestEffects(const ModelData& data, const RemlFit& fit) {
  std::vector<EffectTest> effects;
  Index first = 0;
  for (const std::vector<size_t>& set : ListSets(data.variables.size())) {
    const Index count =
        MakeRow(data.variables, set, std::vector<int>(data.variables.size())).size();
    if (!set.empty()) {
      MatrixXd contrasts = MatrixXd::Zero(count, fit.beta.size());
      contrasts.middleCols(first, count).setIdentity();
      std::string name;
      for (const size_t i : set)
        name += (name.empty() ? "" : " x ") + data.variables[i].factor.name;
      effects.push_back({name, fit.TestContrasts(contrasts)});
    }
    first += count;
  }
  return effects;
}

std::vector<CellEstimate> EstimateCells(const ModelData& data, const RemlFit& fit) {
  std::vector<Factor> factors;
  for (const Variable& variable : data.variables) {
    if (variable.is_within) factors.push_back(variable.factor);
  }
  std::vector<CellEstimate> cells;
  const std::vector<std::string> names = ListCells(factors);
  for (size_t cell = 0; cell < names.size(); ++cell) {
    std::vector<int> levels(data.variables.size(), -1);  // groups: the mean of all
    size_t rest = cell;
    for (size_t i = factors.size(); i-- > 0;) {
      levels[i] = static_cast<int>(rest % factors[i].levels.size());
      rest /= factors[i].levels.size();
    }
    const Eigen::VectorXd contrast = MakeFullRow(data.variables, levels).transpose();
    CellEstimate estimate;
    estimate.cell = names[cell];
    estimate.estimate = contrast.dot(fit.beta);
    estimate.standard_error = std::sqrt(contrast.dot(fit.covariance * contrast));
    estimate.test = TestCoefficient(fit, contrast, estimate.estimate, estimate.standard_error, 0.0);
    cells.push_back(estimate);
  }
  return cells;
}

Answer<EffectsModel> FitData(const ModelData& data, double reference) {
  const std::string fault = FindFault(data);
  if (!fault.empty()) return NoAnswer{fault};
  const std::string empty = FindEmpty(data);
  if (!empty.empty()) return NoAnswer{empty};
  const OwnColumns own = ListOwnColumns(data);
  EffectsModel model;
  const Answer<RungFit> rung = Descend(data, own, model.fallbacks);
  if (!rung) return rung.none();
  model.num_persons = static_cast<int>(data.persons.size());
  model.num_observations = static_cast<int>(data.trials.size());
  model.is_correlated = rung->rung.is_correlated;
  model.residual_sd = rung->fit.sigma;
  model.reml_criterion = rung->fit.criterion;
  model.random = ListRandom(data, *rung);
  model.effects = TestEffects(data, rung->fit);
  if (data.is_quantity) {
    model.slope = EstimateSlope(data, rung->fit, reference);
  } else {
    model.cells = EstimateCells(data, rung->fit);
  }
  return model;
}

/** The trials with a value, at their levels of the chosen factors and of all groups. */
Answer<ModelData> CollectTrials(const MeasureTable& table, const std::vector<size_t>& factors) {
  ModelData data;
  for (const size_t i : factors) data.variables.push_back({table.factors[i], true, {}});
  for (const Factor& group : table.groups) data.variables.push_back({group, false, {}});
  std::map<std::string, std::vector<size_t>> groups;
  for (const Observation& row : table.rows) {
    if (std::isnan(row.value)) continue;
    if (const std::string fault = FindUnusable(row.value); !fault.empty()) {
      return NoAnswer{"person \"" + row.person + "\": " + fault};
    }
    CodedTrial trial = {row.person, row.session, {}, row.value};
    for (const size_t i : factors) {
      Observation own = row;
      if (row.levels.size() == table.factors.size()) own.levels = {row.levels[i]};
      const Answer<size_t> level = FindCell({table.factors[i]}, own);
      if (!level) return level.none();
      trial.levels.push_back(*level);
    }
    const Answer<std::vector<size_t>> own_groups = FindGroups(table.groups, row);
    if (!own_groups) return own_groups.none();
    const auto [known, is_new] = groups.try_emplace(row.person, *own_groups);
    if (is_new) data.persons.push_back(row.person);
    if (known->second != *own_groups) {
      return NoAnswer{"person \"" + row.person + "\" is in two groups"};
    }
    trial.levels.insert(trial.levels.end(), own_groups->begin(), own_groups->end());
    data.trials.push_back(std::move(trial));
  }
  if (data.trials.empty()) return NoAnswer{"no trial has a value"};
  for (Variable& variable : data.variables) {
    const auto num_levels = static_cast<Index>(variable.factor.levels.size());
    if (num_levels > 1) variable.coding = CodeLevels(num_levels);
  }
  return data;
}

}  // namespace

Answer<EffectsModel> FitEffectsModel(const MeasureTable& table) {
  std::vector<size_t> factors(table.factors.size());
  std::iota(factors.begin(), factors.end(), size_t{0});
  const Answer<ModelData> data = CollectTrials(table, factors);
  return data ? FitData(*data, 0.0) : Answer<EffectsModel>(data.none());
}

Answer<EffectsModel> FitQuantityModel(const MeasureTable& table, size_t factor, double reference) {
  const Factor& quantity = table.factors[factor];
  if (quantity.numbers.empty())
    return NoAnswer{"the levels of " + quantity.name + " are no numbers"};
  const Answer<ModelData> collected = CollectTrials(table, {factor});
  if (!collected) return collected.none();
  ModelData data = *collected;
  std::vector<double> x;
  for (const CodedTrial& trial : data.trials) x.push_back(quantity.numbers[trial.levels[0]]);
  const Moments moments = CalcMoments(x);
  if (moments.is_constant) return NoAnswer{"all trials have the same " + quantity.name};
  // About the mean of the trials, in units of their spread.
  data.scale = std::sqrt(moments.sum_of_squares / static_cast<double>(x.size()));
  data.variables[0].coding.resize(static_cast<Index>(quantity.numbers.size()), 1);
  for (size_t i = 0; i < quantity.numbers.size(); ++i) {
    data.variables[0].coding(static_cast<Index>(i), 0) =
        (quantity.numbers[i] - moments.mean) / data.scale;
  }
  data.is_quantity = true;
  return FitData(data, reference);
}

std::string DescribeRandom(const EffectsModel& model) {
  std::string text;
  for (const RandomPart& part : model.random) text += (text.empty() ? "" : ", ") + part.name;
  text = "varies between persons: " + text + (model.is_correlated ? ", correlated" : "");
  for (const std::string& fallback : model.fallbacks) text += "; " + fallback;
  return text;
}

}  // namespace graspbench
