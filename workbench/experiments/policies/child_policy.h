#pragma once
/** @file
A digit controller as a child process. It reads messages from its standard input and writes answers
to its standard output. Each is a 4-byte little-endian length, followed by that many bytes of
MessagePack (core/trial/policy/policy_messages.h). If the process is lost, the message quotes its
standard error. The answer to a reset has at least 60 s of real time, because a controller may load
its weights then. A process serves many trials; after a fault the next trial gets a new one. When it
is ended, so are the processes that it has started. */

#include <memory>
#include <string>

#include "core/trial/policy/hand_policy.h"

namespace graspbench {

/** Largest valid answer [bytes]. */
inline constexpr size_t kMostAnswerBytes = 1 << 20;

/** @param command  for /bin/sh. Nothing starts before the first trial. */
std::unique_ptr<HandPolicy> MakeChildPolicy(const std::string& command);

/** Joins the lines of a text, whose beginning may be missing, into one line. */
std::string FormatLastWords(const std::string& text);

}  // namespace graspbench
