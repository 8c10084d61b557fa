#pragma once
/** @file
The messages between a trial and its controller, as MessagePack (core/base/text/message_pack.h).
Each of our messages is a map with its number and one of

    reset        facts of the trial (ListPolicyFacts); the answer may contain only the number
    observation  observations (ListPolicyObservations), arrays of float64

Each answer is a map with the same number and the entries of ListPolicyActions. Numbers increase
over the lifetime of a connection, so that surplus answers are detected. */

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/text/message_pack.h"
#include "core/trial/policy/hand_policy.h"

namespace graspbench {

/** Computes the observations of a question with their noise, in the order of
ListPolicyObservations. A number has an empty shape; an image has three dimensions. */
using PolicyValues = std::vector<std::pair<std::string_view, PackedArray>>;
PolicyValues FindPolicyValues(const PolicyView& view);
/** Writes the pairs of a map: names and values, images as bytes. */
void WritePolicyValues(const PolicyValues& values, MessagePackWriter& writer);

std::string FormatPolicyReset(uint64_t number, const PolicyView& view);
std::string FormatPolicyQuestion(uint64_t number, const PolicyView& view);

/** @throws PolicyFault if the answer is not MessagePack. */
PackedValue ParsePolicyAnswer(std::string_view answer);
/** Returns the number of an answer. @throws PolicyFault if it is not a map with a number. */
uint64_t ReadPolicyAnswerNumber(const PackedValue& answer);
/** Reads the answer to a question. @throws PolicyFault saying what is wrong with it. */
PolicyAction ReadPolicyAction(const PackedValue& answer, Eigen::Index num_driven);
/** Checks the answer to a reset. @throws PolicyFault for anything but the number or an error. */
void CheckPolicyReset(const PackedValue& answer);

}  // namespace graspbench
