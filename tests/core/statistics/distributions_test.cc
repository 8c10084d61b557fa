#include "core/statistics/distributions.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(NoncentralT, IsThatOfR) {
  // R 4.2: pt(2, 10, 1, lower.tail = FALSE), pt(2.5, 4.5, 3, lower.tail = FALSE).
  EXPECT_NEAR(CalcNoncentralStudentUpperP(2.0, 10.0, 1.0), 0.19238843747, 1e-9);
  EXPECT_NEAR(CalcNoncentralStudentUpperP(2.5, 4.5, 3.0), 0.693198390018, 1e-9);
}

TEST(NoncentralT, WithoutShiftIsStudents) {
  EXPECT_NEAR(CalcNoncentralStudentUpperP(1.3, 7.0, 0.0), CalcStudentUpperP(1.3, 7.0), 1e-12);
}

}  // namespace
}  // namespace graspbench
