#pragma once
/** @file
Settings of a trial in which an external controller closes the digits and may move the hand
(protocols/policy_lift.cc). */

#include <string>

#include "core/base/enum_table.h"

namespace graspbench {

/** What a controller moves. */
enum class PolicyMoves {
  kDigits,         ///< the digits; the strategy does placing and lift
  kHandAndDigits,  ///< also the hand, from the pre-grasp position; the strategy does the lift
  kUntilTouch      ///< as kDigits, until its action "hold" passes the grip to the regulator
};
inline constexpr NamedValue<PolicyMoves> kPolicyMoves[] = {
    {PolicyMoves::kDigits, "digits"},
    {PolicyMoves::kHandAndDigits, "hand-and-digits"},
    {PolicyMoves::kUntilTouch, "digits-until-touch"}};

/** Object pose given to a controller. Only the true pose follows the object. */
enum class PolicyObjectPose {
  kNone,
  kNominal,   ///< nominal pose, at rest
  kBelieved,  ///< pose assumed by the session's positioning, at rest
  kCamera,    ///< pose found by the hand's camera before the hand arrives, at rest
  kTrue       ///< current pose
};
inline constexpr NamedValue<PolicyObjectPose> kPolicyObjectPoses[] = {
    {PolicyObjectPose::kNone, "none"},
    {PolicyObjectPose::kNominal, "nominal"},
    {PolicyObjectPose::kBelieved, "believed"},
    {PolicyObjectPose::kCamera, "camera"},
    {PolicyObjectPose::kTrue, "true"}};

struct PolicyConfig {
  std::string command;           ///< shell command that starts the controller; empty: none
  std::string moves = "digits";  ///< one of kPolicyMoves
  double hand_speed = 0.5;       ///< largest speed of the hand's commanded position [m/s]
  double hand_turn_rate = 2.0;   ///< largest rate of its commanded rotation [rad/s]
  double period = 0.02;          ///< control period, rounded to whole steps of the physics [s]
  int execute_steps = 1;         ///< rows of an action that are used before the next question
  double time = 5.0;             ///< longest time of control, after which the hand lifts [s]
  std::string object_pose = "believed";  ///< one of kPolicyObjectPoses
  int picture = 0;                       ///< side of the wrist camera's image; 0: none [pixel]
  double latency = 0.0;                  ///< from a question until its answer takes effect [s]
  double latency_jitter = 0.0;           ///< largest random addition, drawn per question [s]
  double dropout = 0.0;                  ///< probability that an answer is lost
  double joint_noise = 0.0;              ///< standard deviation of joint positions [rad], [m]
  double force_noise = 0.0;              ///< likewise of forces of digits, palm and grip [N]
  double timeout = 10.0;                 ///< real time for an answer; no effect on results [s]

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
      "believed (as positioning has it), camera (as the hand's camera finds it) or true (where it "
      "is, at every time)");
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
