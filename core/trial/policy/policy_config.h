#pragma once
/** @file
Settings of a trial that a controller of somebody else closes the digits of, and whose hand it may
move (protocols/policy_lift.cc). */

#include <string>

#include "core/base/enum_table.h"

namespace graspbench {

/** What a controller moves. */
enum class PolicyMoves {
  kDigits,         ///< placing and lift are the strategy's
  kHandAndDigits,  ///< the hand begins at the pre-grasp position; the lift is the strategy's
  kUntilTouch      ///< as digits, until its action "hold" gives the grip to the regulator
};
inline constexpr NamedValue<PolicyMoves> kPolicyMoves[] = {
    {PolicyMoves::kDigits, "digits"},
    {PolicyMoves::kHandAndDigits, "hand-and-digits"},
    {PolicyMoves::kUntilTouch, "digits-until-touch"}};

/** Given to a controller: its object's pose. But for the true one it does not follow the object. */
enum class PolicyObjectPose {
  kNone,
  kNominal,   ///< where the object should be, at rest
  kBelieved,  ///< where the session's positioning has it, at rest
  kCamera,    ///< where the hand's camera finds it before the hand comes, at rest
  kTrue       ///< where it is
};
inline constexpr NamedValue<PolicyObjectPose> kPolicyObjectPoses[] = {
    {PolicyObjectPose::kNone, "none"},
    {PolicyObjectPose::kNominal, "nominal"},
    {PolicyObjectPose::kBelieved, "believed"},
    {PolicyObjectPose::kCamera, "camera"},
    {PolicyObjectPose::kTrue, "true"}};

struct PolicyConfig {
  std::string command;           ///< for the shell, starts the controller; empty: there is none
  std::string moves = "digits";  ///< of kPolicyMoves
  double hand_speed = 0.5;       ///< largest, of the hand's commanded position [m/s]
  double hand_turn_rate = 2.0;   ///< largest, of its commanded rotation [rad/s]
  double period = 0.02;          ///< of control, rounded to whole steps of the physics [s]
  int execute_steps = 1;         ///< rows of an action that are used before the next question
  double time = 5.0;             ///< of control at most; then the hand lifts [s]
  std::string object_pose = "believed";  ///< of kPolicyObjectPoses
  int picture = 0;                       ///< side of the wrist camera's; 0: none [pixel]
  double latency = 0.0;                  ///< from a question until its answer takes effect [s]
  double latency_jitter = 0.0;           ///< at most so much more, drawn for each question [s]
  double dropout = 0.0;                  ///< probability that an answer is lost
  double joint_noise = 0.0;              ///< standard deviation, of joint positions [rad], [m]
  double force_noise = 0.0;              ///< the same of forces of digits, palm and grip [N]
  double timeout = 10.0;                 ///< of an answer, in real time; changes no result [s]

  template <class V>
  void Visit(V&& v) {
    v("command", command,
      "shell command that starts a controller of the digits, as python3 my.py; empty: the strategy "
      "controls them");
    v("moves", moves,
      "what a controller moves: digits, hand-and-digits (from the pre-grasp position) or "
      "digits-until-touch (until it says hold; then the grip is regulated)");
    v("hand_speed_m_per_s", hand_speed,
      {"largest speed of the hand that a controller moves; faster commands are cut", 0.001, 5});
    v("hand_turn_rate_rad_per_s", hand_turn_rate,
      {"largest turn rate of the hand that a controller moves; faster commands are cut", 0.001,
       20});
    v("period_s", period,
      {"control period: time between two rows of a controller's actions, rounded to whole steps of "
       "the physics",
       1e-4, 0.1});
    v("execute_steps", execute_steps,
      {"rows of an action that are carried out before the controller is asked again", 1, 1000});
    v("time_s", time,
      {"longest time of control; a controller that has not said done by then is lifted with", 0.05,
       60});
    v("object_pose", object_pose,
      "what a controller is told of the object's pose: none, nominal (where it should be), "
      "believed "
      "(as positioning has it), camera (as the hand's camera finds it) or true (where it is, at "
      "every time)");
    v("picture_px", picture,
      {"side of the wrist camera's picture that a controller gets with every question; 0: none", 0,
       1024});
    v("latency_s", latency,
      {"simulated time from a controller's question until its answer takes effect", 0, 1});
    v("latency_jitter_s", latency_jitter,
      {"largest further latency, drawn evenly for each question", 0, 1});
    v("dropout", dropout,
      {"probability that an answer is lost; the drives then hold what was asked for before", 0,
       0.99});
    v("joint_noise_rad", joint_noise,
      {"standard deviation of the noise of a controller's joint_positions, of sliding joints in m",
       0, 0.5});
    v("force_noise_n", force_noise,
      {"standard deviation of the noise of a controller's digit_forces, palm_force and grip_force",
       0, 100});
    v("timeout_s", timeout,
      {"real time after which a controller that has not answered counts as lost", 0.05, 3600});
  }
};

}  // namespace graspbench
