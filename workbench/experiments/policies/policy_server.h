#pragma once
/** @file
What a policy server gets and what its answers mean: policy.yaml. It maps the messages of a
controller (core/trial/policy/policy_messages.h) to those of a server that speaks openpi's, and
back. An address alone (ws://..) stands for the observations under their own names, with the facts of
the trial as `reset` in the first question, and for answers with `actions` or `targets`, rows of
targets, or `increments`, and with `done`. */

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/file_keys.h"
#include "core/trial/policy/policy_messages.h"

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

/** What passes between one trial and its server. */
class ServerExchange {
 public:
  /** @pre CheckPolicyServer; the server's description outlives it.
  @param facts  of the trial (ListPolicyFacts). */
  ServerExchange(const PolicyServer& server, PackedValue facts);

  /** The next message to the server. @throws PolicyLost where the trial does not give what the file
  takes. */
  std::string FormatQuestion(const PolicyValues& observation);
  /** @param observation  of the question.
  @throws PolicyFault saying what is wrong with the answer. */
  PolicyAction ReadAnswer(const PolicyValues& observation, std::string_view answer) const;

 private:
  using Indices = std::vector<int>;  ///< -1: there is none

  /** Where the columns of the server's rows go. */
  struct Columns {
    Indices joint, pose, twist;  ///< of each column, in the driven joints, the pose and the twist
    int done = -1, hold = -1;    ///< columns
  };
  /** The joints of a ServerValue, among all and among the driven ones. */
  struct Joints {
    Indices of_all, of_driven;
  };

  void WriteValue(size_t number, const PolicyValues& observation, MessagePackWriter& writer) const;
  PackedArray FindSource(const ServerValue& value, const std::string& name,
                         const PolicyValues& observation) const;
  void AppendJoints(size_t number, const std::string& name, const PackedArray& source,
                    std::vector<double>& numbers) const;
  std::string FillText(const ServerValue& value) const;
  PackedValue TranslateRows(const PackedArray& rows, const PolicyValues& observation) const;
  [[noreturn]] void Fail(const std::string& key, const std::string& text) const;

  const PolicyServer& server_;
  const PackedValue facts_;
  const std::vector<std::string> joints_, driven_;
  std::vector<Joints> picked_;     // of each value of the server's observation
  std::vector<std::string> maps_;  // of the server's observation, in the order of the file
  Columns columns_;
  bool is_first_ = true;
};

}  // namespace graspbench
