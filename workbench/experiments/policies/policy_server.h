#pragma once
/** @file
What a policy server is told and what its answers mean: policy.yaml. It maps the messages of a
controller (core/trial/policy/policy_messages.h) to those of a server that speaks openpi's, and
back. An address alone (ws://..) stands for the observations under their own names, with the facts of
the trial as `reset` in the first question, and for answers with `actions` or `targets`, rows of
targets, or `increments`, and with `done`. */

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/file_keys.h"
#include "core/base/text/message_pack.h"
#include "core/trial/policy/hand_policy.h"

namespace graspbench {

/** "ws://[::1]:8000/path" */
struct ServerAddress {
  std::string host, port, path;
};

/** A value of the server's observation. */
struct ServerValue {
  std::string key, under;           ///< `under`: of the map that holds it; empty: the observation
  std::vector<std::string> from;    ///< observations and facts, one behind the other
  std::vector<std::string> joints;  ///< those that are taken of each; empty: all
  std::string dtype;                ///< "float32", "float64"; of a picture "uint8"
  std::vector<double> size;         ///< of a picture: height, width; empty: as it is
  std::string text;                 ///< instead of `from`; {object} stands for that fact
};

struct ServerActions {
  std::string key = "actions";
  bool are_increments = false;
  /** Of each column: a driven joint, a component of the hand's pose or twist, "done" or "hold"
  (above 0.5), or "-" (left out). Empty: the driven joints in their order. */
  std::vector<std::string> columns;
};

struct PolicyServer {
  std::string source;  ///< file or address, for messages
  ServerAddress address;
  bool is_mapped = false;  ///< else the names are ours
  std::vector<ServerValue> observation;
  ServerActions actions;
};

/** Whether the command of a policy is an address or a policy.yaml; else it is one for the shell. */
bool IsPolicyServer(const std::string& command);

/** Of an address, or of a policy.yaml. @throws Error(kFormat) with all that is wrong in the file;
Error(kUsage) for an address that is none. */
PolicyServer LoadPolicyServer(const std::string& command);

/** hand.x .. hand.qz and hand.vx .. hand.wz: the order of hand_pose and of hand_twist. */
const std::vector<std::string>& ListPoseColumns();
const std::vector<std::string>& ListTwistColumns();

/** What can be said before a trial. @throws Error(kFormat) where the file names joints that the hand
does not have, or does not give what policy.moves waits for. */
void CheckPolicyServer(const PolicyServer& server, const Hand& hand, const PolicyConfig& policy);

/** The keys of policy.yaml. */
const FileKeys& ListPolicyServerKeys();

/** The message to the server. @param facts, observation  of the trial, as parsed from the messages
of a controller. @throws PolicyLost where the trial does not give what the file takes. */
std::string FormatServerQuestion(const PolicyServer& server, const PackedValue& facts,
                                 const PackedValue& observation, bool is_first);

/** @pre CheckPolicyServer. @throws PolicyFault saying what is wrong with the answer. */
PolicyAction ReadServerAnswer(const PolicyServer& server, const PackedValue& facts,
                              const PackedValue& observation, std::string_view answer);

}  // namespace graspbench
