#include "core/physics/cholesky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

namespace graspbench {
namespace {

/** Columns that are finished before the rest of the matrix hears of them. */
constexpr int kBlock = 8;
constexpr int kUnblockedBelow = 32;
/** Columns of a block that are solved together. */
constexpr int kPanel = 4;

template <int kRows>
using Rows = Eigen::Array<double, kRows, 1>;

template <int kRows>
auto MapRows(double* x) {
  return Eigen::Map<Rows<kRows>>(x);
}

/** Calls strip(rows, first row) for strips that cover [begin, end), whose number of rows is a
constant: their sums stay in registers. */
template <class Strip>
void ForEachStrip(int begin, int end, Strip&& strip) {
  int i = begin;
  for (; i + 8 <= end; i += 8) strip(std::integral_constant<int, 8>(), i);
  if (i + 4 <= end) {
    strip(std::integral_constant<int, 4>(), i);
    i += 4;
  }
  if (i + 2 <= end) {
    strip(std::integral_constant<int, 2>(), i);
    i += 2;
  }
  if (i < end) strip(std::integral_constant<int, 1>(), i);
}

/** By row the first column that is not zero; what is before it stays zero in the factor. */
using RowStarts = std::vector<int>;

const RowStarts& FindRowStarts(const Eigen::MatrixXd& H) {
  thread_local RowStarts starts;
  starts.resize(static_cast<size_t>(H.rows()));
  for (int i = 0; i < static_cast<int>(H.rows()); ++i) {
    int j = 0;
    while (j < i && H(i, j) == 0.0) ++j;
    starts[i] = j;
  }
  return starts;
}

/** H_ic -= sum over j in [first, last) of H_ij H_cj, rows i in [begin, end), columns c = k, .. */
template <int kColumns>
void SubtractProducts(Eigen::MatrixXd& H, int first, int last, int k, int begin, int end) {
  const Eigen::Index n = H.rows();
  double* data = H.data();
  ForEachStrip(begin, end, [&](auto num_rows, int i) {
    std::array<Rows<num_rows>, kColumns> sum;
    for (auto& s : sum) s.setZero();
    for (int j = first; j < last; ++j) {
      const Rows<num_rows> rows = MapRows<num_rows>(data + j * n + i);
      for (int c = 0; c < kColumns; ++c) sum[c] += rows * data[j * n + k + c];
    }
    for (int c = 0; c < kColumns; ++c) MapRows<num_rows>(data + (k + c) * n + i) -= sum[c];
  });
}

/** The factor of the block of rows and columns [begin, end). */
bool FactorBlock(Eigen::MatrixXd& H, const RowStarts& starts, int begin, int end) {
  for (int k = begin; k < end; ++k) {
    double* column = H.col(k).data();
    const int first = std::max(begin, starts[k]);
    if (k > first) SubtractProducts<1>(H, first, k, k, k, end);
    if (column[k] <= 0.0) return false;
    const double root = std::sqrt(column[k]);
    column[k] = root;
    for (int i = k + 1; i < end; ++i) column[i] /= root;
  }
  return true;
}

/** The rows below the block whose factor is done. */
void SolveBelow(Eigen::MatrixXd& H, const RowStarts& starts, int begin, int end) {
  const Eigen::Index n = H.rows();
  double* data = H.data();
  for (int k = begin; k < end; ++k) {
    const int panel = begin + (k - begin) / kPanel * kPanel;
    const int first = std::max(begin, starts[k]);
    const double inverse = 1.0 / H(k, k);
    ForEachStrip(end, static_cast<int>(n), [&](auto num_rows, int i) {
      auto rows_at = [&](int j) { return MapRows<num_rows>(data + j * n + i); };
      Rows<num_rows> x = rows_at(k);
      if (panel > first) {
        Rows<num_rows> sum = Rows<num_rows>::Zero();
        for (int j = first; j < panel; ++j) sum += rows_at(j) * data[j * n + k];
        x -= sum;
      }
      for (int j = std::max(panel, first); j < k; ++j) x -= rows_at(j) * data[j * n + k];
      rows_at(k) = x * inverse;
    });
  }
}

/** What the finished columns [begin, end) mean for those behind them. */
void UpdateBehind(Eigen::MatrixXd& H, const RowStarts& starts, int begin, int end) {
  const int n = static_cast<int>(H.rows());
  int k = end;
  for (; k + 2 <= n; k += 2) {
    const int first = std::max(begin, starts[k]);
    const int first_of_both = std::max(begin, std::min(starts[k], starts[k + 1]));
    if (first < end) SubtractProducts<1>(H, first, end, k, k, k + 1);
    if (first_of_both < end) SubtractProducts<2>(H, first_of_both, end, k, k + 1, n);
  }
  const int first = k < n ? std::max(begin, starts[k]) : end;
  if (first < end) SubtractProducts<1>(H, first, end, k, k, n);
}

}  // namespace

bool FactorCholesky(Eigen::MatrixXd& H) {
  const int n = static_cast<int>(H.rows());
  const RowStarts& starts = FindRowStarts(H);
  const int block = n < kUnblockedBelow ? std::max(n, 1) : kBlock;
  for (int begin = 0; begin < n; begin += block) {
    const int end = std::min(begin + block, n);
    if (!FactorBlock(H, starts, begin, end)) return false;
    SolveBelow(H, starts, begin, end);
    UpdateBehind(H, starts, begin, end);
  }
  return true;
}

}  // namespace graspbench
