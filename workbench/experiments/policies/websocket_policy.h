#pragma once
/** @file
A digit controller behind a websocket (RFC 6455) with the protocol of openpi's policy servers. The
server greets with a map of metadata. Then each binary message is an observation and each answer a
map with actions, both in MessagePack. A text message reports a server error: after a question it is
an invalid answer. The protocol has no reset, so each trial opens a connection. A server that cannot
be reached, closes, is silent for policy.timeout_s or greets differently is lost. */

#include <memory>

#include "core/trial/policy/hand_policy.h"
#include "workbench/experiments/policies/policy_server.h"

namespace graspbench {

/** Allows servers on other machines; without it, only loopback addresses are allowed. It applies to
the whole program, because it is the consent of the user who runs it, not a setting of a session. */
void AllowRemotePolicies();

/** Makes a controller that connects at the first trial. @throws Error(kUsage) for a server on
another machine; PolicyLost for an unknown host. */
std::unique_ptr<HandPolicy> MakeWebsocketPolicy(PolicyServer server);

}  // namespace graspbench
