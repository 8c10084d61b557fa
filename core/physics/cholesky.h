#pragma once
/** @file
The factor of small symmetric matrices in the solver's inner loop.

Sums run in the order of Eigen 3.4's LLT, so the results are the same bits where its sizes are
multiples of 4 or below 32; it takes less than half the time, because nothing is packed, copied or
dispatched at some 30 unknowns. Zeros before the first entry of a row, as between the joints of two
fingers, are skipped. */

#include <Eigen/Core>

namespace graspbench {

/** L of H = L L^T in place of H's lower triangle, which alone is read; false when H is not positive
definite. @pre square. */
bool FactorCholesky(Eigen::MatrixXd& H);

}  // namespace graspbench
