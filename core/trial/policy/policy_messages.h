#pragma once
/** @file
The messages between a trial and its controller, as MessagePack (core/base/text/message_pack.h). Each
of ours is a map with its number and one of

    reset        facts of the trial (ListPolicyFacts); the answer may be empty but for the number
    observation  observations (ListPolicyObservations), arrays of float64

and each answer a map with the same number, and what ListPolicyActions has. Numbers grow through the
life of a connection, so that an answer too many is found. */

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/text/message_pack.h"
#include "core/trial/policy/hand_policy.h"

namespace graspbench {

/** The observations of a question with their noise, in the order of ListPolicyObservations. A number
has an empty shape, a picture has three sizes. */
using PolicyValues = std::vector<std::pair<std::string_view, PackedArray>>;
PolicyValues FindPolicyValues(const PolicyView& view);
/** Pairs of a map: names and values, pictures as bytes. */
void WritePolicyValues(const PolicyValues& values, MessagePackWriter& writer);

std::string FormatPolicyReset(uint64_t number, const PolicyView& view);
std::string FormatPolicyQuestion(uint64_t number, const PolicyView& view);

/** @throws PolicyFault where the answer is no MessagePack. */
PackedValue ParsePolicyAnswer(std::string_view answer);
/** The number of an answer. @throws PolicyFault where it is no map with one. */
uint64_t ReadPolicyAnswerNumber(const PackedValue& answer);
/** Of the answer to a question. @throws PolicyFault saying what is wrong with it. */
PolicyAction ReadPolicyAction(const PackedValue& answer, Eigen::Index num_driven);
/** Of the answer to a reset. @throws PolicyFault for anything but the number or an error. */
void CheckPolicyReset(const PackedValue& answer);

}  // namespace graspbench
