#pragma once
/** @file
A controller of digits behind a websocket (RFC 6455), as openpi's policy servers speak it: the server
greets with a map of metadata; then each binary message is an observation and each answer a map with
actions, both MessagePack. A text is the error of the server: after a question it is a wrong answer.
That wire knows no reset: each trial opens a connection. A server that cannot be reached, closes, is
silent for policy.timeout_s or greets otherwise is lost. */

#include <memory>

#include "core/trial/policy/hand_policy.h"
#include "workbench/experiments/policies/policy_server.h"

namespace graspbench {

/** Without it, only servers of this machine (loopback) are asked. For the whole program: it is the
consent of who runs it, and no setting of a session. */
void AllowRemotePolicies();

/** Nothing is connected before the first trial. @throws Error(kUsage) for a server on another
machine, PolicyLost for one whose host is not known. */
std::unique_ptr<HandPolicy> MakeWebsocketPolicy(PolicyServer server);

}  // namespace graspbench
