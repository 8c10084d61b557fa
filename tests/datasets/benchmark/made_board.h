#pragma once
/** @file
Boards of known results: nothing is simulated. */

#include <string>
#include <vector>

#include "datasets/benchmark/board.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

/** Objects "o0".. with growing friction and falling mass. */
inline SessionInputs MakeBoardInputs(int num_objects) {
  SessionInputs inputs;
  for (int i = 0; i < num_objects; ++i) {
    const auto object = MakeFakeObject("o" + std::to_string(i));
    object->surface.friction_static = 0.1 + 0.01 * i;
    object->mass_properties.mass = 1.0 - 0.01 * i;
    inputs.objects.push_back(object);
  }
  return inputs;
}

/** Of hand "tum".
@param successes  of `trials` trials on each object: the first ones succeed.
@param id  enters the results, so that no two entries are the same. */
inline Session MakeBoardSession(const std::string& id, const std::vector<int>& successes,
                                int trials, int seed = 1) {
  Session session;
  session.config.hands = {"tum"};
  session.config.trials = trials;
  session.config.seed = seed;
  for (size_t object = 0; object < successes.size(); ++object) {
    for (int trial = 0; trial < trials; ++trial) {
      TrialRecord record;
      record.plan = {id + std::to_string(object) + "-" + std::to_string(trial),
                     "tum",
                     "o" + std::to_string(object),
                     "g1",
                     trial,
                     {}};
      record.result.outcome =
          trial < successes[object] ? Outcome::kSuccess : Outcome::kSlippedInLiftOff;
      record.result.reason = id;
      record.result.timing.gct = 0.5;
      record.result.timing.gft_ratio = 0.25;
      session.plan.push_back(record.plan);
      session.records.push_back(record);
    }
  }
  return session;
}

inline BoardEntry MakeBoardEntry(const std::string& name, const std::vector<int>& successes,
                                 int trials) {
  BoardEntry entry;
  entry.facts = {name, "A. Person", "CC0-1.0", "", "As shipped.", "made/1", ""};
  entry.pack = name + ".tar";
  entry.sha256 = name;
  const Session session = MakeBoardSession(name, successes, trials);
  entry.public_draws = TakeDraws(session);
  entry.reproduction = CompareRecords(session, session);
  return entry;
}

inline Board MakeBoard(std::vector<BoardEntry> entries, int num_objects) {
  Board board;
  board.benchmark.name = "made/1";
  board.benchmark.physics = 1;
  for (int i = 0; i < num_objects; ++i) {
    board.benchmark.objects.emplace_back("o" + std::to_string(i), "0123456789abcdef");
  }
  board.entries = std::move(entries);
  RankEntries(MakeBoardInputs(num_objects), board);
  return board;
}

}  // namespace graspbench
