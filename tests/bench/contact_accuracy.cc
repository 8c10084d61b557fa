// How far contacts and GFT are from the truth over conditions of recording, on reaches of a
// generator that shares nothing with the analysis (tests/human_study/protocol): the table of
// human_study/ACCURACY.md.
//   contact_accuracy [--seed TEXT] [--trials N] [--detector ID] [--all] [--only WORD]
// --all takes every rate and noise; without it three of each are taken. Rules were chosen on the
// seed "develop"; the table is made with another.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/human_study/protocol/protocol_study.h"

namespace graspbench::protocol {
namespace {

struct MarkerSet {
  const char* name;
  int num_markers;
  double edge;
  bool has_shape;
};

constexpr MarkerSet kMarkerSets[] = {
    {"one marker", 1, 0.0, true},         {"triangle 15 mm", 3, 15e-3, true},
    {"triangle 30 mm", 3, 30e-3, true},   {"triangle 60 mm", 3, 60e-3, true},
    {"30 mm, no shape", 3, 30e-3, false}, {"none", 0, 0.0, false},
};

struct Behaviour {
  const char* name;
  void (*set)(Conditions& conditions);
};

const Behaviour kBehaviours[] = {
    {"rigid", [](Conditions&) {}},
    {"yield 2 mm", [](Conditions& c) { c.yield = 2e-3; }},
    {"nail marker", [](Conditions& c) { c.nail_markers = true; }},
    {"push 5 mm", [](Conditions& c) { c.push = 5e-3; }},
    {"soft approach",
     [](Conditions& c) {
       c.min_touch_speed = 10e-3;
       c.max_touch_speed = 25e-3;
     }},
    {"half hidden", [](Conditions& c) { c.hidden_share = 0.5; }},
    {"ring hovers", [](Conditions& c) { c.hovering_digit = 3; }},
    {"true GFT 0", [](Conditions& c) { c.min_gft = c.max_gft = 0.0; }},
};

struct Recorder {
  double rate, noise;
};

std::vector<Recorder> ListRecorders(bool all) {
  if (!all) return {{100, 0.5e-3}, {200, 0.3e-3}, {500, 0.1e-3}};
  std::vector<Recorder> recorders;
  for (const double rate : {60.0, 100.0, 200.0, 500.0}) {
    for (const double noise : {0.1e-3, 0.3e-3, 0.5e-3, 1e-3}) recorders.push_back({rate, noise});
  }
  return recorders;
}

void PrintHeading() {
  std::printf(
      "| rate [Hz] | noise [mm] | object markers | behaviour | kept | found | false | bias "
      "[ms] | SD [ms] | coverage | GFT bias [ms] | GFT SD [ms] | median GFT [ms] | of a true zero "
      "[ms] | limit [ms] |\n");
  std::printf(
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- "
      "|\n");
}

void PrintRow(const Recorder& recorder, const char* markers, const char* behaviour,
              const Judged& judged) {
  const Accuracy a = CompareWithTruth(judged);
  const ZeroGft& zero = judged.result.statistics.zero_gft;
  std::printf(
      "| %g | %g | %s | %s | %d/%d | %d/%d | %d | %.1f | %.1f | %.2f | %.1f | %.1f | %.1f | %.1f | "
      "%.1f |\n",
      recorder.rate, 1e3 * recorder.noise, markers, behaviour, a.num_kept, a.num_trials,
      a.num_contacts, a.num_true_contacts, a.num_false_contacts, 1e3 * a.bias, 1e3 * a.sd,
      a.coverage, 1e3 * a.gft_bias, 1e3 * a.gft_sd, 1e3 * a.median_gft, 1e3 * zero.median,
      1e3 * zero.limit);
  std::fflush(stdout);
}

int Run(int argc, char** argv) {
  std::string seed = "evaluate", detector, only;
  int num_trials = 40;
  bool all = false;
  for (int i = 1; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (std::strcmp(argv[i], "--all") == 0) {
      all = true;
    } else if (std::strcmp(argv[i], "--seed") == 0 && has_value) {
      seed = argv[++i];
    } else if (std::strcmp(argv[i], "--trials") == 0 && has_value) {
      num_trials = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--detector") == 0 && has_value) {
      detector = argv[++i];
    } else if (std::strcmp(argv[i], "--only") == 0 && has_value) {
      only = argv[++i];
    } else {
      std::fprintf(stderr, "unknown or incomplete option %s\n", argv[i]);
      return 2;
    }
  }
  PrintHeading();
  for (const Recorder& recorder : ListRecorders(all)) {
    for (const MarkerSet& markers : kMarkerSets) {
      for (const Behaviour& behaviour : kBehaviours) {
        const std::string name = std::string(markers.name) + " " + behaviour.name;
        if (!only.empty() && name.find(only) == std::string::npos) continue;
        StudyPlan plan;
        plan.make_reach = MakeProtocolReach;
        plan.conditions = MakeProtocolConditions();
        plan.seed = seed;
        plan.trials_per_person = num_trials / plan.num_people;
        plan.conditions.rate = recorder.rate;
        plan.conditions.noise_sd = recorder.noise;
        plan.conditions.num_object_markers = markers.num_markers;
        plan.conditions.triangle_edge = markers.edge;
        plan.has_shape = markers.has_shape;
        behaviour.set(plan.conditions);
        if (!detector.empty()) plan.settings = "contact: {detector: " + detector + "}\n";
        PrintRow(recorder, markers.name, behaviour.name, RunPlan(plan));
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace graspbench::protocol

int main(int argc, char** argv) { return graspbench::protocol::Run(argc, argv); }
