#include "human_study/statistics/reliability/retest.h"

#include <algorithm>

#include "core/base/text/text.h"

namespace graspbench {
Answer<Retest> CalcRetest(const MeasureTable& table) {
  Retest retest;
  retest.sessions = table.sessions;
  if (retest.sessions.size() < 2) {
    return NoAnswer{FormatCount(retest.sessions.size(), "session") + "; expected 2 or more"};
  }
  // A session that is a factor, too, is no condition within itself.
  MeasureTable by_session = table;
  for (size_t i = by_session.factors.size(); i-- > 0;) {
    const auto is_session = [i](const Observation& row) {
      return i < row.levels.size() && row.levels[i] == row.session;
    };
    if (!std::all_of(by_session.rows.begin(), by_session.rows.end(), is_session)) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    by_session.factors.erase(by_session.factors.begin() + at);
    for (Observation& row : by_session.rows) row.levels.erase(row.levels.begin() + at);
  }
  // The session becomes the last factor, so that the cells of a person are session by session.
  Factor session;
  session.name = "session, of the retest";
  session.levels = retest.sessions;
  by_session.factors.push_back(session);
  for (Observation& row : by_session.rows) row.levels.push_back(row.session);
  const Answer<CellMeans> cells = CalcCellMeans(by_session);
  if (!cells) return cells.none();
  retest.left_out = cells->left_out;
  const auto num_sessions = static_cast<Eigen::Index>(retest.sessions.size());
  std::vector<std::vector<double>> columns(retest.sessions.size());
  for (size_t person = 0; person < cells->persons.size(); ++person) {
    PersonTrials own = {cells->persons[person], {}};
    for (Eigen::Index s = 0; s < num_sessions; ++s) {
      double sum = 0.0;
      for (Eigen::Index cell = s; cell < cells->means.cols(); cell += num_sessions) {
        sum += cells->means(static_cast<Eigen::Index>(person), cell);
      }
      own.values.push_back(sum * static_cast<double>(num_sessions) /
                           static_cast<double>(cells->means.cols()));
      columns[static_cast<size_t>(s)].push_back(own.values.back());
    }
    retest.persons.push_back(std::move(own));
  }
  retest.reliability = CalcReliability(retest.persons);
  for (size_t b = 1; b < columns.size(); ++b) {
    retest.shifts.push_back({b - 1, b, CalcPairedTTest(columns[b], columns[b - 1])});
  }
  return retest;
}

}  // namespace graspbench
