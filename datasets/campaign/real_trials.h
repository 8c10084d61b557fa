#pragma once
/** @file
A laboratory's trials with real hands, for comparison with a campaign's simulated ones. The table
has one row per trial and is comma- or tab-separated:

    hand, object   ids of the campaign
    variant        standard, new-pregrasp or new-target
    trial          number, from 0; once per hand, object and variant
    success        1, yes, 0 or no; empty: not done yet, the row is ignored
    t_TH_s, ..     optional, one column per digit: its first contact since the start of closure [s];
                   empty: it never touched
    note           optional; trials whose note contains "made up" are marked as synthetic

The trials are stored in the campaign's folder, in real/trials.csv. Published trials and figures of
real hands are shipped in datasets/real and used if a laboratory has none of its own. */

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/grasp/contact_timing.h"
#include "core/optimise/optimise_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

struct RealTrial {
  int line = 0;  ///< in the table
  std::string hand, object;
  Variant variant = kStandardGrasp;
  int trial = 0;
  bool is_success = false;
  bool is_made_up = false;
  bool is_published = false;           ///< from datasets/real
  std::vector<DigitContact> contacts;  ///< one per column; none: not measured
};

/** Reads the trials that were done. Every fault is added to `problems` with its line. */
std::vector<RealTrial> ReadRealTrials(const std::string& text, const std::string& file,
                                      Diagnostics& problems);

/** Adds hands, objects and digits that the campaign does not have to `problems`. */
void CheckRealTrials(const std::vector<RealTrial>& trials, const std::string& file,
                     const SessionInputs& inputs, Diagnostics& problems);

/** Stores the trials in the campaign, replacing earlier ones. @throws Error(kIo). */
void KeepRealTrials(const std::filesystem::path& campaign, const std::string& text);
/** Loads the campaign's trials, if any. @throws Error(kFormat, kIo). */
std::vector<RealTrial> LoadRealTrials(const std::filesystem::path& campaign);

/** A hand and an object, by their ids. */
using RealScene = std::pair<std::string, std::string>;
/** Loads the published trials of these scenes. @throws Error(kFormat, kIo). */
std::vector<RealTrial> LoadPublishedTrials(const std::vector<RealScene>& scenes);

/** A published measurement. */
struct PublishedFigure {
  std::string hand;  ///< id, or "people"
  std::string what;
  double value = 0.0;
  std::string unit, source;
};
/** Loads the figures in datasets/real. @throws Error(kFormat, kIo). */
std::vector<PublishedFigure> LoadPublishedFigures();

}  // namespace graspbench
