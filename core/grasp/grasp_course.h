#pragma once
/** @file
Recorded course of a reach: hand and digits of a grasp over time, in place of the strategy's own
placing and closing. The strategy starts placing with it and closure at `closure_start`. It ends
when the hand stands at the grasp position; then the digits continue at the speed of their closing
schedules.

Between instants of equal distance values follow a cubic with the slopes of their neighbours
(Catmull and Rom 1974), and arrive with slope zero. Before the first and after the last they stay
constant. */

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace graspbench {

struct GraspCourse {
  double period = 0.02;        ///< between instants [s]
  double closure_start = 0.0;  ///< start of closure, after the first instant [s]
  /** Displacement of the hand from its grasp position by instant, in axes of H [m]; the last is
  zero. Empty: there is no course. */
  std::vector<Eigen::Vector3d> p_HAway;
  /** Closing s in [0, 1] by digit and instant. */
  std::map<std::string, std::vector<double>> closing;

  bool is_set() const { return !p_HAway.empty(); }
  /** From the first to the last instant [s]. */
  double duration() const { return period * (static_cast<double>(p_HAway.size()) - 1.0); }
};

/** @param time  since the first instant [s].   @pre the course is set. */
Eigen::Vector3d CalcHandAway(const GraspCourse& course, double time);
Eigen::Vector3d CalcHandSpeed(const GraspCourse& course, double time);  ///< its rate [m/s]
/** @param values  of one digit by instant; empty: 0.   @return in [0, 1]. */
double CalcCourseClosing(const std::vector<double>& values, double period, double time);

}  // namespace graspbench
