#pragma once
/** @file
A controller of digits as a child process: it reads messages from its standard input and writes
answers to its standard output, each a length of 4 bytes, little endian, then so many bytes of
MessagePack (core/trial/policy/policy_messages.h). Its standard error is quoted where it is lost. The
answer to a reset has at least 60 s of real time, because a controller may load its weights then. It
lives through many trials; after a fault the next trial gets a new one. When it is ended, so is what
it has started. */

#include <memory>
#include <string>

#include "core/trial/policy/hand_policy.h"

namespace graspbench {

/** An answer of more bytes is a fault. */
inline constexpr size_t kMostAnswerBytes = 1 << 20;

/** @param command  for /bin/sh. Nothing starts before the first trial. */
std::unique_ptr<HandPolicy> MakeChildPolicy(const std::string& command);

/** The lines of a text whose beginning may be missing, as one. */
std::string FormatLastWords(const std::string& text);

}  // namespace graspbench
