#pragma once
/** @file
A campaign's numbers as tables in its folder: summary.csv, a line for each cell and variant of the
benchmark, and comparison.csv, one for each search of the comparison. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/base/units.h"
#include "core/optimise/optimise_steps.h"
#include "datasets/campaign/campaign_store.h"

namespace graspbench {

/** What the benchmark's trials of one scene and variant say. */
struct VariantSummary {
  std::string hand, object, grasp;
  Variant variant = kStandardGrasp;
  int trials = 0;
  int successes = 0;
  double mean_sigma = kUnset;  ///< [N]
  double median_gft_ratio = kUnset;
  double gft_ratio_floor = kUnset;
  double median_got_ratio = kUnset;
  double median_gct = kUnset;             ///< [s]
  double mean_breaking_force = kUnset;    ///< [N]
  double median_grip = kUnset;            ///< [N]
  double median_sigma_ratio = kUnset;     ///< of the grip
  double median_breaking_ratio = kUnset;  ///< of the grip
  double headroom_share = kUnset;         ///< step 2's (headrooms.h): start and what was kept

  template <class V>
  static void ListFields(V&& field) {
    using S = VariantSummary;
    field("hand", &S::hand, FieldColumn{"", "id of the hand"});
    field("object", &S::object, FieldColumn{"", "id of the object"});
    field("grasp", &S::grasp, FieldColumn{"", "id of the grasp"});
    field("variant", &S::variant, FieldColumn{"", "standard, new-pregrasp or new-target"});
    field("trials", &S::trials, FieldColumn{"", "finished trials"});
    field("successes", &S::successes, FieldColumn{"", "those that succeeded"});
    field("mean_sigma", &S::mean_sigma, FieldColumn{"N", "a trial without sigma counts 0"});
    field("median_gft_ratio", &S::median_gft_ratio,
          FieldColumn{"", "a trial in which a digit never touched counts as infinite"});
    field("gft_ratio_floor", &S::gft_ratio_floor,
          FieldColumn{"", "of GFT%, were only the trials' scatter left; empty: none"});
    field("median_got_ratio", &S::median_got_ratio, FieldColumn{"", "as of GFT%"});
    field("median_gct_s", &S::median_gct,
          FieldColumn{"s", "of the trials in which every digit touched"});
    field("mean_breaking_force_n", &S::mean_breaking_force,
          FieldColumn{"N", "of the judged trials; a lost object counts 0"});
    field("median_grip_n", &S::median_grip,
          FieldColumn{"N", "sum of the hand's normal forces in the hold"});
    field("median_sigma_per_grip", &S::median_sigma_ratio, FieldColumn{"", "of what was held"});
    field("median_breaking_per_grip", &S::median_breaking_ratio,
          FieldColumn{"", "of what was held and judged"});
    field(
        "headroom_share", &S::headroom_share,
        FieldColumn{"",
                    "of mu N - m g, borne in step 2's check: of the new pre-grasp, its start, and "
                    "of the new target, what it kept; empty: none"});
  }
};
std::vector<VariantSummary> SummariseVariants(const Campaign& campaign);

/** Writes summary.csv and, when there is one, comparison.csv, and seals them in the campaign's
manifest.
@throws Error(kIo). */
void ExportCampaign(const std::filesystem::path& folder, const Campaign& campaign);

}  // namespace graspbench
