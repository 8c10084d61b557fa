#include "human_study/statistics/condition_means.h"

#include <cmath>
#include <limits>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/multiple_tests.h"

namespace graspbench {
namespace {

/** Standard deviation of each column over persons. */
Eigen::VectorXd CalcSpread(const Eigen::MatrixXd& y) {
  const Eigen::MatrixXd deviations = y.rowwise() - y.colwise().mean();
  return (deviations.colwise().squaredNorm() / static_cast<double>(y.rows() - 1))
      .cwiseSqrt()
      .transpose();
}

}  // namespace

const std::vector<BarKind>& ListBarKinds() {
  static const std::vector<BarKind> kinds = {BarKind::kBetweenPerson, BarKind::kLoftusMasson,
                                             BarKind::kCousineau, BarKind::kCousineauMorey};
  return kinds;
}

std::string_view NameOf(BarKind kind) {
  switch (kind) {
    case BarKind::kBetweenPerson:
      return "95 % between-person interval of each mean";
    case BarKind::kLoftusMasson:
      return "95 % within-person interval, Loftus-Masson";
    case BarKind::kCousineau:
      return "95 % within-person interval, Cousineau (uncorrected)";
    case BarKind::kCousineauMorey:
      return "95 % within-person interval, Cousineau-Morey";
  }
  return "";
}

Answer<Eigen::VectorXd> CalcHalfWidths(const CellMeans& cells, BarKind kind) {
  const Eigen::MatrixXd& y = cells.means;
  const double num_persons = static_cast<double>(y.rows());
  const double num_cells = static_cast<double>(y.cols());
  if (y.rows() < 2) return NoAnswer{FormatCount(y.rows(), "person") + "; expected 2 or more"};
  const double t = CalcStudentQuantile(0.975, num_persons - 1.0);
  if (kind == BarKind::kBetweenPerson)
    return Eigen::VectorXd(t * CalcSpread(y) / std::sqrt(num_persons));

  if (y.cols() < 2) return NoAnswer{"one condition: no differences within persons"};
  const Eigen::MatrixXd normalised = (y.colwise() - y.rowwise().mean()).array() + y.mean();
  const Eigen::VectorXd spread = CalcSpread(normalised);
  if (kind == BarKind::kLoftusMasson) {
    const double ms_error = spread.squaredNorm() / (num_cells - 1.0);
    const double half_width = CalcStudentQuantile(0.975, (num_persons - 1.0) * (num_cells - 1.0)) *
                              std::sqrt(ms_error / num_persons);
    return Eigen::VectorXd(Eigen::VectorXd::Constant(y.cols(), half_width));
  }
  const double correction =
      kind == BarKind::kCousineauMorey ? std::sqrt(num_cells / (num_cells - 1.0)) : 1.0;
  return Eigen::VectorXd(t * correction * spread / std::sqrt(num_persons));
}

std::vector<PairComparison> ComparePairs(const CellMeans& cells) {
  const auto list_column = [&](size_t cell) {
    const auto column = cells.means.col(static_cast<Eigen::Index>(cell));
    return std::vector<double>(column.begin(), column.end());
  };
  const size_t num_cells = static_cast<size_t>(cells.means.cols());
  std::vector<PairComparison> pairs;
  std::vector<double> p;
  for (size_t a = 0; a < num_cells; ++a) {
    for (size_t b = a + 1; b < num_cells; ++b) {
      PairComparison pair;
      pair.a = a;
      pair.b = b;
      pair.test = CalcPairedTTest(list_column(b), list_column(a));
      p.push_back(pair.test ? pair.test->p : std::numeric_limits<double>::quiet_NaN());
      pairs.push_back(std::move(pair));
    }
  }
  const std::vector<double> adjusted = AdjustHolm(p);
  for (size_t i = 0; i < pairs.size(); ++i) pairs[i].p_holm = adjusted[i];
  return pairs;
}

std::vector<GroupComparison> CompareGroups(const CellMeans& cells) {
  const Eigen::VectorXd means = cells.means.rowwise().mean();
  const auto list_means = [&](size_t group, size_t level) {
    std::vector<double> own;
    for (size_t person = 0; person < cells.persons.size(); ++person) {
      if (cells.group_levels[person][group] == level) {
        own.push_back(means(static_cast<Eigen::Index>(person)));
      }
    }
    return own;
  };
  std::vector<GroupComparison> pairs;
  std::vector<double> p;
  for (size_t group = 0; group < cells.groups.size(); ++group) {
    const size_t num_levels = cells.groups[group].levels.size();
    for (size_t a = 0; a < num_levels; ++a) {
      for (size_t b = a + 1; b < num_levels; ++b) {
        GroupComparison pair;
        pair.group = group;
        pair.a = a;
        pair.b = b;
        pair.test = CalcWelchTest(list_means(group, b), list_means(group, a));
        p.push_back(pair.test ? pair.test->p : std::numeric_limits<double>::quiet_NaN());
        pairs.push_back(std::move(pair));
      }
    }
  }
  const std::vector<double> adjusted = AdjustHolm(p);
  for (size_t i = 0; i < pairs.size(); ++i) pairs[i].p_holm = adjusted[i];
  return pairs;
}

}  // namespace graspbench
