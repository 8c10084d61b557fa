// Which search finds the better grasp at an equal number of evaluations: spaces and methods of step
// 2, and pagmo's CMA-ES, each from the same starts by the same evaluation. Run again it goes on from
// its journals. Training shapes have sizes that no catalogue object has.
//
//   search_bench DIR --scenes training  --spaces thumb,hand-pose --methods es,random,pagmo
//   search_bench DIR --scenes benchmark --methods es,random --no-judge --evaluations 300
//   search_bench DIR --scenes benchmark --every 4 --fitness strength --evaluations 100
//   search_bench DIR --scenes functions --methods es,cmaes,pagmo,random --seeds 21 --evaluations 300
//
// "functions" asks no simulation: how far from known optima the methods end.
//
// Each search's ten fittest are screened on 3 drawn trials, the best is judged on 20 others; methods
// are compared with the first space and method, scene by scene and seed by seed.
#include <CLI/CLI.hpp>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/optimise/learning_trial.h"
#include "core/optimise/methods/search.h"
#include "core/shape/synthetic_shapes.h"
#include "core/statistics/bootstrap.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "objects/catalogue.h"
#include "workbench/experiments/scene_runner.h"
#ifdef GRASPBENCH_HAS_PAGMO
#include "tests/bench/pagmo_search.h"
#endif

namespace graspbench {
namespace {

namespace fs = std::filesystem;

constexpr int kCandidates = 10, kScreening = 3, kJudging = 20;
constexpr int kFirstScreening = 4000, kFirstJudging = 3000;  // as in grasp_optimiser.cc
constexpr int kShapeSeed = 100;  // shapes that no shipped grasp was developed on
constexpr double kLargestShape = 0.8;

struct Options {
  std::string folder, scenes = "training";
  std::vector<std::string> hands = {"tum", "shadow"}, spaces = {"thumb"}, methods = {"es"};
  std::string fitness = "sigma";
  int num_shapes = 8, evaluations = 200, seeds = 1;
  int every = 1;  // benchmark: only every so many objects, from the first
  bool no_judge = false, race = false;
  double minutes = 1e9;  // of processor time, then no new scene is begun
};

struct BenchScene {
  std::string name;
  SceneConfig config;
  SceneInputs inputs;
  Grasp start;
};

struct Found {
  double fitness = 0.0;  // the best of the search
  double judged = 0.0, grip = 0.0;
  double seconds = 0.0;  // of processor time in the search, without what its journal had
  double strength = 0.0, share = 0.0;  // in the mean; of what friction and grip allow
  int successes = 0;
};

BenchScene MakeScene(const SceneConfig& config, const SceneInputs& inputs) {
  BenchScene scene;
  scene.config = config;
  scene.config.optimise.step = "2";
  scene.inputs = inputs;
  scene.name = inputs.hand->id + "-" + inputs.object->id + "-" + inputs.grasp.id;
  scene.start = MakeObjectGrasp(*inputs.hand, *inputs.object, inputs.grasp, NameOf(kNewTarget));
  return scene;
}

std::vector<BenchScene> ListTrainingScenes(const Options& options) {
  std::vector<Eigen::Vector3d> judges;
  for (const std::string& id : ListObjects()) {
    judges.push_back(LoadObject(id, FieldUse::kLater)->size);
  }
  const std::vector<std::string> taxa = {"g1", "g3", "g2", "g5"};
  std::vector<BenchScene> scenes;
  for (int k = 0; k < options.num_shapes; ++k) {
    for (const std::string& id : options.hands) {
      const auto hand = std::make_shared<const Hand>(LoadHand(id));
      const std::string& taxon = taxa[static_cast<size_t>(k) % taxa.size()];
      for (const Grasp& grasp : LoadStandardGrasps(*hand)) {
        if (grasp.id != taxon) continue;
        const int number = k / static_cast<int>(taxa.size());
        const double largest = kLargestShape * CalcPreGraspWidth(*hand, grasp);
        const auto shapes =
            MakeShapes(taxon, ShapeUse::kTraining, kShapeSeed, number + 1, largest, judges);
        SceneConfig config;
        config.hand = id;
        config.object = shapes.back()->id;
        config.grasp = taxon;
        scenes.push_back(MakeScene(config, {hand, CompleteObject(shapes.back()), grasp}));
      }
    }
  }
  return scenes;
}

std::vector<BenchScene> ListBenchmarkScenes(const Options& options) {
  std::vector<BenchScene> scenes;
  int number = 0;
  for (const std::string& object : ListObjects()) {
    if (number++ % options.every != 0) continue;
    for (const std::string& hand : options.hands) {
      SceneConfig config;
      config.hand = hand;
      config.object = object;
      config.grasp = "best";
      const SceneInputs inputs = LoadSceneInputs(config);
      scenes.push_back(MakeScene(config, inputs));
    }
  }
  return scenes;
}

SearchResult RunMethod(const OptimiseConfig& config, const SearchSpace& box,
                       const RandomStream& stream, const EvaluateGeneration& evaluate) {
#ifdef GRASPBENCH_HAS_PAGMO
  if (config.method == "pagmo") {
    return RunPagmoSearch(box, config.evaluations, static_cast<unsigned>(config.seed), evaluate);
  }
#endif
  return RunSearch(config.method, box, config.evaluations, stream, evaluate);
}

/** @param method  "start": the start alone. */
Found RunOne(const BenchScene& scene, const std::string& space, const std::string& method, int seed,
             const Options& options, TrialPool& pool) {
  SceneConfig config = scene.config;
  config.optimise.search = space;
  config.optimise.method = method == "start" ? "random" : method;
  config.optimise.seed = seed;
  config.optimise.fitness = options.fitness;
  config.optimise.evaluations = method == "start" ? 1 : options.evaluations;
  const fs::path path =
      fs::path(options.folder) /
      (scene.name + "-" + options.fitness + (options.race ? "-raced-" : "-") + space + "-" +
       method + "-" + std::to_string(options.evaluations) + "-" + std::to_string(seed) + ".jsonl");
  EvaluationJournal journal(path);
  const RunLearningTrials run =
      MakeJournaledTrials(config, scene.inputs, journal, pool, [](const auto&, const auto&) {});
  TargetSearch search(*scene.inputs.hand, *scene.inputs.object, scene.start, config.optimise);
  Found found;
  std::vector<int> simulated;
  const auto simulate = [&](const std::vector<Individual>& generation) {
    for (const Individual& individual : generation) simulated.push_back(individual.number);
    return search.Evaluate(generation, run);
  };
  Race race(search.space().box());
  const bool is_raced = method != "start" && options.race;
  const std::clock_t begun = std::clock();
  const SearchResult result =
      RunMethod(config.optimise, search.space().box(), search.MakeStream(),
                [&](const std::vector<Individual>& generation) {
                  return is_raced ? race.Evaluate(generation, simulate) : simulate(generation);
                });
  found.seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  found.fitness = result.individuals[static_cast<size_t>(result.best)].fitness;
  if (options.no_judge) return found;
  Individual chosen = result.individuals.front();
  const std::vector<Finalist> screened =
      search.Rank(LearningStage::kScreening, FindCandidates(result, simulated, kCandidates),
                  ListDraws(kFirstScreening, kScreening), run);
  if (!screened.empty()) chosen = result.individuals[static_cast<size_t>(screened[0].number)];
  const std::vector<LearningTrial> trials =
      search.Rank(LearningStage::kFinalist, {chosen}, ListDraws(kFirstJudging, kJudging), run)
          .at(0)
          .trials;
  found.judged = CalcFitness(trials, search.grip_limit());
  found.grip = CalcMeanGrip(trials);
  found.strength = CalcMeanStrength(trials);
  found.share = CalcHeadroom(trials, *scene.inputs.object, config.sim.gravity).share;
  found.successes = CountSuccesses(trials);
  return found;
}

using Table = std::map<std::string, std::vector<Found>>;  // by "space method", a pair an element

std::string FormatMean(const std::vector<double>& values, int decimals) {
  std::string text = FormatFixed(CalcMean(values), decimals);
  const auto interval = CalcBootstrap(
      values.size(),
      [&](const std::vector<size_t>& members) {
        double sum = 0.0;
        for (const size_t member : members) sum += values[member];
        return sum / static_cast<double>(members.size());
      },
      "search bench");
  if (!interval) return text;
  return text + " (" + FormatFixed(interval->interval.low, decimals) + " to " +
         FormatFixed(interval->interval.high, decimals) + ")";
}

/** Each column against the first. */
void PrintComparison(const std::vector<std::string>& columns, const Table& table, bool is_judged) {
  const std::vector<Found>& reference = table.at(columns.front());
  const auto value = [&](const Found& found) { return is_judged ? found.judged : found.fitness; };
  std::printf("\n%zu pairs, each against \"%s\" by %s\n", reference.size(), columns.front().c_str(),
              is_judged ? "mean fitness of 20 fresh trials" : "the search's best fitness");
  for (const std::string& column : columns) {
    const std::vector<Found>& found = table.at(column);
    int won = 0, lost = 0;
    std::vector<double> log_ratios, log_strengths, successes;
    for (size_t i = 0; i < found.size(); ++i) {
      const double a = value(found[i]), b = value(reference[i]);
      won += a > b;
      lost += a < b;
      if (a > 0.0 && b > 0.0) log_ratios.push_back(std::log(a / b));
      if (found[i].strength > 0.0 && reference[i].strength > 0.0) {
        log_strengths.push_back(std::log(found[i].strength / reference[i].strength));
      }
      successes.push_back(100.0 * (found[i].successes - reference[i].successes) / kJudging);
    }
    std::printf("%-20s won %d, lost %d: %s", column.c_str(), won, lost,
                FormatRateInterval(won, won + lost).c_str());
    std::printf("; log ratio of the %zu where both hold %s", log_ratios.size(),
                log_ratios.empty() ? "n/a" : FormatMean(log_ratios, 3).c_str());
    if (!log_strengths.empty()) {
      std::printf("; of strength %s, median %.3f", FormatMean(log_strengths, 3).c_str(),
                  CalcMedian(log_strengths));
    }
    if (is_judged) std::printf("; success points %s", FormatMean(successes, 1).c_str());
    std::printf("\n");
  }
}

struct KnownFunction {
  const char* name;
  double (*calc)(const Eigen::VectorXd& from_optimum);
};
constexpr KnownFunction kFunctions[] = {
    {"sphere", [](const Eigen::VectorXd& d) { return d.squaredNorm(); }},
    {"ellipsoid, axes 1 to 1000",
     [](const Eigen::VectorXd& d) {
       double sum = 0.0;
       for (Eigen::Index i = 0; i < d.size(); ++i) {
         const double share = static_cast<double>(i) / static_cast<double>(d.size() - 1);
         sum += std::pow(1000.0, 2.0 * share) * d[i] * d[i];
       }
       return sum;
     }},
    {"rugged (Rastrigin)",
     [](const Eigen::VectorXd& d) {
       return (25.0 * d.array().square() + 10.0 - 10.0 * (2.0 * kPi * 5.0 * d.array()).cos()).sum();
     }},
};

/** The median over the seeds of what is left of each function, in a box like a digit's. */
void CompareOnFunctions(const Options& options) {
  for (const KnownFunction& function : kFunctions) {
    for (const int size : {3, 5, 9}) {
      std::printf("%-26s %d coordinates:", function.name, size);
      for (const std::string& method : options.methods) {
        std::vector<double> left;
        for (int seed = 1; seed <= options.seeds; ++seed) {
          const Eigen::VectorXd one = Eigen::VectorXd::Ones(size);
          SearchSpace box{-one, one, 0.0 * one, 0.32};
          const std::string id = std::to_string(size) + " " + std::to_string(seed);
          RandomStream place(id, "optimum");
          const Eigen::VectorXd optimum = 0.8 * DrawUniformPoint(box, place);
          OptimiseConfig config;
          config.method = method;
          config.seed = seed;
          config.evaluations = options.evaluations;
          const SearchResult result =
              RunMethod(config, box, RandomStream(id, method), [&](const auto& generation) {
                std::vector<double> fitness;
                for (const Individual& individual : generation) {
                  fitness.push_back(-function.calc(individual.genome - optimum));
                }
                return fitness;
              });
          left.push_back(-result.individuals[static_cast<size_t>(result.best)].fitness);
        }
        std::printf("  %s %.2g", method.c_str(), CalcMedian(left));
      }
      std::printf("\n");
    }
  }
}

int Run(const Options& options) {
  if (options.scenes == "functions") {
    CompareOnFunctions(options);
    return 0;
  }
  fs::create_directories(options.folder);
  const std::vector<BenchScene> scenes =
      options.scenes == "training" ? ListTrainingScenes(options) : ListBenchmarkScenes(options);
  std::vector<std::pair<std::string, std::string>> searches;
  for (const std::string& space : options.spaces) {
    for (const std::string& method : options.methods) {
      // Other methods on the first space only: spaces are compared with one method.
      if (space == options.spaces.front() || method == options.methods.front()) {
        searches.emplace_back(space, method);
      }
    }
  }
  if (!options.no_judge) searches.emplace_back(options.spaces.front(), "start");
  std::vector<std::string> columns;
  for (const auto& [space, method] : searches) columns.push_back(space + " " + method);
  const std::atomic<bool> stop = false;
  TrialPool pool(1, stop);
  Table table;
  for (int seed = 1; seed <= options.seeds; ++seed) {
    for (const BenchScene& scene : scenes) {
      if (std::clock() > 60.0 * options.minutes * CLOCKS_PER_SEC) continue;
      std::printf("%s, seed %d\n", scene.name.c_str(), seed);
      for (size_t i = 0; i < searches.size(); ++i) {
        const auto& [space, method] = searches[i];
        const Found found = RunOne(scene, space, method, seed, options, pool);
        table[columns[i]].push_back(found);
        std::printf("  %-20s %7.1f s  fitness %8.4f", columns[i].c_str(), found.seconds,
                    found.fitness);
        if (!options.no_judge) {
          std::printf(
              "  judged %8.4f  success %2d of %d  grip %5.1f N  strength %.3f N, %.2f of "
              "what friction allows",
              found.judged, found.successes, kJudging, found.grip, found.strength, found.share);
        }
        std::printf("\n");
        std::fflush(stdout);
      }
    }
  }
  if (table.empty()) return 1;
  PrintComparison(columns, table, !options.no_judge);
  std::printf("%.1f min of processor time in this run\n",
              static_cast<double>(std::clock()) / CLOCKS_PER_SEC / 60.0);
  return 0;
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  graspbench::Options options;
  CLI::App app("Compares search spaces and methods of step 2.");
  app.add_option("DIR", options.folder)->required();
  app.add_option("--scenes", options.scenes)
      ->check(CLI::IsMember({"training", "benchmark", "functions"}));
  app.add_option("--hands", options.hands)->delimiter(',');
  app.add_option("--spaces", options.spaces)->delimiter(',');
  app.add_option("--methods", options.methods)->delimiter(',');
  app.add_option("--shapes", options.num_shapes);
  app.add_option("--fitness", options.fitness);
  app.add_option("--every", options.every);
  app.add_option("--evaluations", options.evaluations);
  app.add_option("--seeds", options.seeds);
  app.add_option("--minutes", options.minutes);
  app.add_flag("--no-judge", options.no_judge);
  app.add_flag("--race", options.race);
  CLI11_PARSE(app, argc, argv);
  try {
    return graspbench::Run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "search_bench: %s\n", error.what());
    return 1;
  }
}
