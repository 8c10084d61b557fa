#pragma once
/** @file
People's grasps on robot hands (core/transfer): what was kept of each, and what trials say of them
beside the standard and the rehearsed grasp on the same draws.

A session of transferred grasps has, of each hand on each object, "best", "rehearsed" and every
transferred grasp. Its inputs/grasps/transfer.json lists all that were tried, transferable or not. */

#include <string>
#include <utility>
#include <vector>

#include "core/base/text/csv.h"
#include "core/base/text/record_fields.h"
#include "datasets/analysis/pairs.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** A pad beside the person's. */
struct TransferPad {
  std::string digit, person;  ///< "RF"; "RF+LF"
  double distance = 0.0;      ///< [m]
  double angle = 0.0;         ///< [rad]
  bool is_reached = true;

  template <class V>
  static void ListFields(V&& field) {
    using P = TransferPad;
    field("digit", &P::digit);
    field("person", &P::person);
    field("distance_m", &P::distance);
    field("angle_rad", &P::angle);
    field("is_reached", &P::is_reached);
  }
};

/** One person's grasp on one hand. */
struct TransferRow {
  std::string hand, object, participant;
  std::string grasp;             ///< id of the grasp in the session; of each source
  std::string not_transferable;  ///< reason; empty: it is in the session
  std::vector<TransferPad> pads;
  std::vector<std::string> undetermined;  ///< joints

  template <class V>
  static void ListFields(V&& field) {
    using R = TransferRow;
    field("hand", &R::hand);
    field("object", &R::object);
    field("participant", &R::participant);
    field("grasp", &R::grasp);
    field("not_transferable", &R::not_transferable);
    field("pads", &R::pads);
    field("undetermined", &R::undetermined);
  }
};

struct TransferFile {
  std::string study;  ///< its name
  std::vector<TransferRow> rows;

  template <class V>
  static void ListFields(V&& field) {
    field("study", &TransferFile::study);
    field("rows", &TransferFile::rows);
  }
};

inline constexpr const char* kTransferPath = "inputs/grasps/transfer.json";
/** Of a session of transferred grasps. @throws Error(kFormat, kIo). */
TransferFile LoadTransferFile(const std::filesystem::path& folder);

/** Of a hand on all objects, or on one. */
struct TransferSummary {
  std::string hand, object;  ///< empty object: all
  int num_grasps = 0, num_transferred = 0;
  /** Over the pads of transferred grasps; NaN: none. */
  double median_distance = kUnset, median_angle = kUnset;  ///< [m], [rad]
  double near_share = kUnset;                              ///< of pads within 2 mm
  Tally transferred, rehearsed, standard;
  /** Success of the transferred grasps less that of the others on the same draws. */
  ChangeEstimate over_rehearsed, over_standard;

  double transferable_share() const { return CalcShare(num_transferred, num_grasps); }
};

/** By hand over all objects, then each hand's objects, in the file's order. */
std::vector<TransferSummary> SummariseTransfers(const TransferFile& file, const Session& session);
std::vector<CsvColumn<TransferSummary>> ListTransferColumns();

/** Reasons why grasps were not transferable on a hand, most frequent first. Those that differ in
numbers alone are one, with the numbers of the first. */
std::vector<std::pair<std::string, int>> CountTransferReasons(const TransferFile& file,
                                                              const std::string& hand);

/** Pads of one digit of a hand, of transferred grasps. */
struct TransferDigit {
  std::string hand, digit;
  int num_pads = 0;
  double median_distance = kUnset, largest_distance = kUnset;  ///< [m]
  double median_angle = kUnset;                                ///< [rad]
};
std::vector<TransferDigit> ListTransferDigits(const TransferFile& file);
std::vector<CsvColumn<TransferDigit>> ListTransferDigitColumns();

}  // namespace graspbench
