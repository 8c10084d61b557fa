#include "datasets/shards/shard.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>
#include <tuple>

#include "core/base/error.h"
#include "core/base/text/text.h"

namespace graspbench {

namespace {

constexpr size_t kNumSentinels = 3;

/** Of "3/7" or "3of7-0.jsonl"; count 0: it is no such text. @param rest  what follows. */
Shard ParsePair(std::string_view text, std::string_view between, std::string_view& rest) {
  Shard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec != std::errc()) return {0, 0};
  rest = std::string_view(number.ptr, static_cast<size_t>(end - number.ptr));
  if (rest.substr(0, between.size()) != between) return {0, 0};
  rest.remove_prefix(between.size());
  const auto count = std::from_chars(rest.data(), end, shard.count);
  if (count.ec != std::errc()) return {0, 0};
  rest = std::string_view(count.ptr, static_cast<size_t>(end - count.ptr));
  const bool is_shard = 1 <= shard.number && shard.number <= shard.count;
  return is_shard ? shard : Shard{0, 0};
}

/** Cards of at most so many trials; each group in pieces that are as equal as can be. */
std::vector<int> CutCards(const std::vector<int>& group_sizes, int num_pieces) {
  std::vector<int> cards;
  for (const int size : group_sizes) {
    const int pieces = std::min(size, num_pieces);
    for (int i = 0; i < pieces; ++i) {
      const int64_t all = size;
      cards.push_back(static_cast<int>(all * (i + 1) / pieces - all * i / pieces));
    }
  }
  return cards;
}

/** Trials of the largest shard. */
int FindLargestHand(const std::vector<int>& cards, int num_shards) {
  std::vector<int> sizes(static_cast<size_t>(num_shards), 0);
  for (size_t i = 0; i < cards.size(); ++i) sizes[i % sizes.size()] += cards[i];
  return *std::max_element(sizes.begin(), sizes.end());
}

/** The first trial of every draw, in the plan's order. */
std::vector<PlannedTrial> ListDraws(const std::vector<PlannedTrial>& plan) {
  std::set<std::tuple<std::string, std::string, int>> known;
  std::vector<PlannedTrial> draws;
  for (const PlannedTrial& planned : plan) {
    if (known.emplace(planned.hand, planned.object, planned.trial).second) draws.push_back(planned);
  }
  return draws;
}

/** @param unit  "trial": what the plan is of. */
std::vector<PlannedTrial> Partition(const std::vector<PlannedTrial>& plan, const Shard& shard,
                                    const std::string& unit) {
  if (static_cast<size_t>(shard.count) > plan.size()) {
    throw Error(ErrorKind::kUsage, FormatCount(shard.count, "shard") + " of " +
                                       FormatCount(static_cast<int64_t>(plan.size()), unit) +
                                       ": expected at most as many shards as " + unit + "s");
  }
  std::vector<int> group_sizes;
  const PlannedTrial* last = nullptr;
  for (const PlannedTrial& planned : plan) {
    const bool is_same = last && last->hand == planned.hand && last->object == planned.object;
    if (!is_same) group_sizes.push_back(0);
    ++group_sizes.back();
    last = &planned;
  }
  const std::vector<int> shards = DealGroups(group_sizes, shard.count);
  std::vector<PlannedTrial> trials;
  for (size_t i = 0; i < plan.size(); ++i) {
    if (shards[i] == shard.number) trials.push_back(plan[i]);
  }
  return trials;
}

}  // namespace

Shard ParseShard(const std::string& text) {
  std::string_view rest;
  const Shard shard = ParsePair(text, "/", rest);
  if (shard.count == 0 || !rest.empty()) {
    throw Error(ErrorKind::kUsage, "--shard \"" + text +
                                       "\": expected a number from 1 to N and how many shards N "
                                       "there are, as in 3/7");
  }
  return shard;
}

std::string FormatShard(const Shard& shard) {
  return std::to_string(shard.number) + "/" + std::to_string(shard.count);
}

bool IsCardOf(size_t card, const Shard& shard) {
  return card % static_cast<size_t>(shard.count) + 1 == static_cast<size_t>(shard.number);
}

std::string FormatLabel(const Shard& shard) {
  return std::to_string(shard.number) + "of" + std::to_string(shard.count);
}

Shard FindShardOfFile(const std::string& name) {
  std::string_view rest;
  const Shard shard = ParsePair(name, "of", rest);
  return rest.substr(0, 1) == "-" ? shard : Shard{0, 0};
}

std::vector<int> DealGroups(const std::vector<int>& group_sizes, int num_shards) {
  int64_t num_trials = 0;
  for (const int size : group_sizes) num_trials += size;
  std::vector<int> cards = CutCards(group_sizes, 1);
  for (int pieces = 2;; pieces *= 2) {
    const int largest = FindLargestHand(cards, num_shards);
    const bool is_even = 5 * static_cast<int64_t>(largest) * num_shards <= 6 * num_trials;
    if (is_even || *std::max_element(cards.begin(), cards.end()) == 1) break;
    cards = CutCards(group_sizes, pieces);
  }
  std::vector<int> shards;
  shards.reserve(static_cast<size_t>(num_trials));
  for (size_t i = 0; i < cards.size(); ++i) {
    shards.insert(shards.end(), static_cast<size_t>(cards[i]),
                  static_cast<int>(i % static_cast<size_t>(num_shards)) + 1);
  }
  return shards;
}

std::vector<PlannedTrial> PartitionPlan(const std::vector<PlannedTrial>& plan, const Shard& shard) {
  return Partition(plan, shard, "trial");
}

std::vector<PlannedTrial> PartitionDraws(const std::vector<PlannedTrial>& plan,
                                         const Shard& shard) {
  std::set<std::tuple<std::string, std::string, int>> own;
  for (const PlannedTrial& draw : Partition(ListDraws(plan), shard, "draw")) {
    own.emplace(draw.hand, draw.object, draw.trial);
  }
  std::vector<PlannedTrial> trials;
  std::copy_if(plan.begin(), plan.end(), std::back_inserter(trials), [&](const auto& planned) {
    return own.count({planned.hand, planned.object, planned.trial}) > 0;
  });
  return trials;
}

int CountDraws(const std::vector<PlannedTrial>& plan) {
  return static_cast<int>(ListDraws(plan).size());
}

std::vector<PlannedTrial> ListSentinels(const std::vector<PlannedTrial>& plan) {
  std::vector<PlannedTrial> first, others;
  std::set<std::string> hands;
  for (const PlannedTrial& planned : plan) {
    const bool is_first = hands.insert(planned.hand).second;
    if (is_first || others.size() < kNumSentinels) (is_first ? first : others).push_back(planned);
  }
  first.insert(first.end(), others.begin(), others.end());
  first.resize(std::min(first.size(), kNumSentinels));
  return first;
}

}  // namespace graspbench
