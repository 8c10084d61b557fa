#pragma once
/** @file
A benchmark of two objects and one hand of the program, as a file would give it. */

#include <string>

#include "core/hand/hand.h"
#include "core/physics/sim_config.h"
#include "datasets/benchmark/benchmark_file.h"
#include "objects/catalogue.h"

namespace graspbench {

/** @param more  further lines. */
inline std::string MakeTinyText(const std::string& more = "") {
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"golf_ball", "tea_light"};
  config.grasps = {"predicted"};
  const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater);
  std::string text =
      "name: tiny/1\nabout: two objects\nphysics: " + std::to_string(kPhysicsVersion) +
      "\nopen: [grasps, strategy.grip, policy.command]\n"
      "session: {hands: [tum], trials: 2, seed: 1}\n"
      "hands: {tum: \"" +
      inputs.hands[0].hand->content_hash + "\"}\nobjects:\n";
  for (const auto& object : inputs.objects) {
    text += "  " + object->id + ": \"" + object->content_hash + "\"\n";
  }
  return text + more;
}

inline Benchmark MakeTinyBenchmark() { return ParseBenchmark(MakeTinyText(), "tiny.yaml"); }

}  // namespace graspbench
