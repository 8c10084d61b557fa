#pragma once
/** @file
Human grasps on robot hands (core/transfer): how closely each was reproduced, and how it performs in
trials compared with the standard and the rehearsed grasp on the same draws.

A session of transferred grasps has "best", "rehearsed" and every transferred grasp of each hand on
each object. It may have these grasps a second time, as played: with the course of the person's
reach, under the same name with kPlayedSuffix. Its inputs/grasps/transfer.json lists all attempted
transfers, successful or not. */

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text/csv.h"
#include "core/base/text/record_fields.h"
#include "datasets/analysis/pairs.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** A robot pad compared with the person's. */
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

/** One digit of the person, for figures: positions of the joints from the palm on and of the tip,
three numbers each in O [m]; with one marker only the tip. */
struct TransferPerson {
  std::string digit;
  double lag = kUnset;  ///< of its contact after the first contact [s]
  Eigen::VectorXd open, contact;

  template <class V>
  static void ListFields(V&& field) {
    using P = TransferPerson;
    field("digit", &P::digit);
    field("lag_s", &P::lag);
    field("open_m", &P::open);
    field("contact_m", &P::contact);
  }
};

/** One person's grasp on one hand. */
struct TransferRow {
  std::string hand, object, participant;
  std::string grasp;             ///< id of the grasp in the session, one per source
  std::string not_transferable;  ///< reason; empty: the grasp is in the session
  std::string not_played;        ///< reason; empty: played, or not asked for
  std::string type;              ///< of the standard grasp that it resembles: "power"; empty: none
  std::vector<TransferPad> pads;
  std::vector<std::string> undetermined;  ///< joints
  std::vector<TransferPerson> person;

  template <class V>
  static void ListFields(V&& field) {
    using R = TransferRow;
    field("hand", &R::hand);
    field("object", &R::object);
    field("participant", &R::participant);
    field("grasp", &R::grasp);
    field("not_transferable", &R::not_transferable);
    field("not_played", &R::not_played);
    field("type", &R::type);
    field("pads", &R::pads);
    field("undetermined", &R::undetermined);
    field("person", &R::person);
  }
};

struct TransferFile {
  std::string study;                ///< its name
  std::vector<std::string> doubts;  ///< warnings about sizes and sides
  std::vector<TransferRow> rows;

  template <class V>
  static void ListFields(V&& field) {
    field("study", &TransferFile::study);
    field("doubts", &TransferFile::doubts);
    field("rows", &TransferFile::rows);
  }
};

inline constexpr const char* kPlayedSuffix = "-played";  ///< of the id of a played grasp

inline constexpr const char* kTransferPath = "inputs/grasps/transfer.json";
/** Reads the transfers of a session's folder. @throws Error(kFormat, kIo). */
TransferFile LoadTransferFile(const std::filesystem::path& folder);

/** Grip threshold and breaking force of a group of the session's grasps: medians over trials; NaN:
not measured (graspbench threshold, judge). */
struct TransferLoads {
  double threshold = kUnset;       ///< margin; infinite: half of the draws or more never held
  double breaking_force = kUnset;  ///< [N]
};

/** Results of a hand on all objects, on one, or with one grasp type on all objects. */
struct TransferSummary {
  std::string hand, object;  ///< empty object: all
  std::string type;          ///< empty: all types
  int num_grasps = 0, num_transferred = 0;
  /** Over the pads of transferred grasps; NaN without a pad. */
  double median_distance = kUnset, median_angle = kUnset;  ///< [m], [rad]
  double near_share = kUnset;                              ///< of pads within 2 mm
  Tally transferred, played, rehearsed, standard;
  TransferLoads loads, loads_played, loads_rehearsed, loads_standard;
  /** Success rate of the transferred grasps minus that of the others on the same draws. */
  ChangeEstimate over_rehearsed, over_standard;
  /** Success rate of played grasps minus that of the same grasps without the course, on the same
  draws. */
  ChangeEstimate of_playing;

  double transferable_share() const { return CalcShare(num_transferred, num_grasps); }
};

/** Summarises by hand over all objects, then by object, then by type, in the file's order. */
std::vector<TransferSummary> SummariseTransfers(const TransferFile& file, const Session& session);
std::vector<CsvColumn<TransferSummary>> ListTransferColumns();
std::vector<CsvColumn<TransferSummary>> ListTransferLoadColumns();
std::vector<CsvColumn<TransferSummary>> ListPlayedColumns();

/** Counts the reasons why grasps were not transferable to a hand, or not played, most frequent
first. Reasons that differ only in numbers are merged under the first.
@param reason  TransferRow::not_transferable or TransferRow::not_played. */
std::vector<std::pair<std::string, int>> CountTransferReasons(
    const TransferFile& file, const std::string& hand,
    std::string TransferRow::*reason = &TransferRow::not_transferable);

/** Pads of one digit of a hand in transferred grasps. */
struct TransferDigit {
  std::string hand, digit;
  int num_pads = 0;
  double median_distance = kUnset, largest_distance = kUnset;  ///< [m]
  double median_angle = kUnset;                                ///< [rad]
};
std::vector<TransferDigit> ListTransferDigits(const TransferFile& file);
std::vector<CsvColumn<TransferDigit>> ListTransferDigitColumns();

/** Lags of a digit's contact after the first contact in successful trials, and of the human digits
that it represents [s]. */
struct TransferLags {
  std::string hand, digit;
  std::vector<double> person, transferred, played, standard;
};
std::vector<TransferLags> ListTransferLags(const TransferFile& file, const Session& session);

}  // namespace graspbench
