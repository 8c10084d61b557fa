#pragma once
/** @file
policy.yaml: what a policy server receives and what its answers mean. It maps the messages of a
controller (core/trial/policy/policy_messages.h) to those of a server with openpi's protocol, and
back. Given only an address (ws://..), the observations keep their own names, and the first message
holds the facts of the trial as `reset`. Answers then hold `actions` or `targets` (rows of targets)
or `increments`, and `done`. */

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
  std::string key, under;           ///< `under`: the enclosing map; empty: the observation
  std::vector<std::string> from;    ///< observations and facts, concatenated
  std::vector<std::string> joints;  ///< joints taken from each; empty: all
  std::string dtype;                ///< "float32", "float64"; for images "uint8"
  std::vector<double> size;         ///< of an image: height, width; empty: unchanged
  std::string text;                 ///< replaces `from`; {object} is replaced by that fact
};

struct ServerActions {
  std::string key = "actions";
  bool are_increments = false;
  /** Meaning of each column: a driven joint, a component of the hand's pose or twist, "done" or
  "hold" (set above 0.5), or "-" (ignored). Empty: the driven joints in their order. */
  std::vector<std::string> columns;
};

struct PolicyServer {
  std::string source;  ///< file or address, for messages
  ServerAddress address;
  bool is_mapped = false;  ///< else graspbench's own names apply
  std::vector<ServerValue> observation;
  ServerActions actions;
};

/** Whether a policy's command is an address or a policy.yaml; else it is a shell command. */
bool IsPolicyServer(const std::string& command);

/** Loads an address or a policy.yaml. @throws Error(kFormat) with all problems of the file;
Error(kUsage) for an invalid address. */
PolicyServer LoadPolicyServer(const std::string& command);

/** Column names hand.x .. hand.qz and hand.vx .. hand.wz, in the order of hand_pose and
hand_twist. */
const std::vector<std::string>& ListPoseColumns();
const std::vector<std::string>& ListTwistColumns();

/** Checks the description before a trial. @throws Error(kFormat) when the file names joints that
the hand does not have, or does not supply what policy.moves needs. */
void CheckPolicyServer(const PolicyServer& server, const Hand& hand, const PolicyConfig& policy);

/** The keys of policy.yaml. */
const FileKeys& ListPolicyServerKeys();

/** The message exchange between one trial and its server. */
class ServerExchange {
 public:
  /** @pre CheckPolicyServer passed; the server's description outlives this.
  @param facts  of the trial (ListPolicyFacts). */
  ServerExchange(const PolicyServer& server, PackedValue facts);

  /** Formats the next message to the server. @throws PolicyLost when the trial does not provide an
  observation that the file names. */
  std::string FormatQuestion(const PolicyValues& observation);
  /** Parses the server's answer. @param observation  of the question.
  @throws PolicyFault saying what is wrong with the answer. */
  PolicyAction ReadAnswer(const PolicyValues& observation, std::string_view answer) const;

 private:
  using Indices = std::vector<int>;  ///< -1: none

  /** Destinations of the columns in the server's rows. */
  struct Columns {
    Indices joint, pose, twist;  ///< by column: index of driven joint, pose, twist
    int done = -1, hold = -1;    ///< column indices
  };
  /** Indices of a ServerValue's joints, among all joints and among the driven ones. */
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
  std::vector<Joints> picked_;     // for each value of the server's observation
  std::vector<std::string> maps_;  // maps in the server's observation, in the order of the file
  Columns columns_;
  bool is_first_ = true;
};

}  // namespace graspbench
