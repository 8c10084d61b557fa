#pragma once
/** @file
Trials that a laboratory did with real hands, to stand beside a campaign's simulated ones. A table, a
trial a row, comma- or tab-separated:

    hand, object   ids of the campaign
    variant        standard, new-pregrasp or new-target
    trial          number, from 0; once per hand, object and variant
    success        1, yes, 0 or no; empty: not done yet, the row does not count
    t_TH_s, ..     optional, one column per digit: its first contact since the start of closure [s];
                   empty: it never touched
    note           optional; trials whose note has "made up" in it are called so on the page

They are kept in the campaign's folder, real/trials.csv. Published trials and figures of real hands
come with the program, in datasets/real; they stand there where a laboratory has none of its own. */

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
  bool is_published = false;           ///< of datasets/real
  std::vector<DigitContact> contacts;  ///< of the columns; none: not measured
};

/** The trials that were done. Every fault goes into `problems` with its line. */
std::vector<RealTrial> ReadRealTrials(const std::string& text, const std::string& file,
                                      Diagnostics& problems);

/** What the campaign does not know is a problem: hands, objects, digits. */
void CheckRealTrials(const std::vector<RealTrial>& trials, const std::string& file,
                     const SessionInputs& inputs, Diagnostics& problems);

/** In the place of earlier ones. @throws Error(kIo). */
void KeepRealTrials(const std::filesystem::path& campaign, const std::string& text);
/** None when there are none. @throws Error(kFormat, kIo). */
std::vector<RealTrial> LoadRealTrials(const std::filesystem::path& campaign);

/** A hand and an object, by their ids. */
using RealScene = std::pair<std::string, std::string>;
/** The published ones of these scenes. @throws Error(kFormat, kIo). */
std::vector<RealTrial> LoadPublishedTrials(const std::vector<RealScene>& scenes);

/** Something that was measured once. */
struct PublishedFigure {
  std::string hand;  ///< id, or "people"
  std::string what;
  double value = 0.0;
  std::string unit, source;
};
/** @throws Error(kFormat, kIo). */
std::vector<PublishedFigure> LoadPublishedFigures();

}  // namespace graspbench
