#include "datasets/trajectory/trajectory_form.h"

namespace graspbench {
namespace {

std::vector<CsvColumn<TrajectoryContact>> ListTrajectoryContactColumns(const Hand& hand) {
  using Row = TrajectoryContact;
  std::vector<CsvColumn<Row>> columns = {
      {"time_s", "s", "since the start of placing",
       [](const Row& row) { return row.instant->time; }},
      {"link", "", "link of the hand",
       [&hand](const Row& row) { return hand.links[static_cast<size_t>(row.contact->link)].name; }},
      {"digit", "string", "", "digit of that link; palm: none", [&hand](const Row& row) {
         const int digit = hand.FindDigitOfLink(row.contact->link);
         return Json(digit < 0 ? "palm" : hand.digits[static_cast<size_t>(digit)].id);
       }}};
  for (const CsvColumn<Row>& column : ListContactNumbers()) columns.push_back(column);
  columns.push_back({"state", "", "sticks, at its limit or slides",
                     [](const Row& row) { return DescribeState(*row.contact); }});
  return columns;
}

std::vector<CsvColumn<TrajectoryEvent>> ListTrajectoryEventColumns() {
  using Event = TrajectoryEvent;
  return {{"time_s", "s", "since the start of placing", &Event::time},
          {"kind", "", "phase, touch, lost, regained or slip", &Event::kind},
          {"phase", "", "that begins", &Event::phase},
          {"digit", "", "of a contact event; palm: none", &Event::digit},
          {"link", "", "of a contact event", &Event::link},
          {"impulse_ns", "N s", "normal impulse of the touch that was lost", &Event::impulse}};
}

struct TaxelInstant {
  double time;
  std::vector<double> forces;
};

/** The elements' forces, a column each. */
std::string FormatTaxelForces(const TrialTrajectory& trajectory) {
  using Row = TaxelInstant;
  std::vector<CsvColumn<Row>> columns = {{"time_s", "s", "since the start of placing", &Row::time}};
  for (const TrajectoryTaxel& taxel : ListTaxels(*trajectory.hand)) {
    columns.push_back({"element_" + std::to_string(taxel.index) + "_n", "N", "on its cell",
                       [i = taxel.index](const Row& row) { return row.forces[i]; }});
  }
  std::vector<Row> rows;
  for (const TraceInstant& instant : trajectory.traced.trace) {
    rows.push_back({instant.time, CalcTaxelForces(trajectory, instant)});
  }
  return FormatCsv(columns, rows);
}

std::vector<TrajectoryFile> MakeCsvFiles(const TrialTrajectory& trajectory) {
  std::vector<TrajectoryContact> contacts;
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (const HandContact& contact : instant.contacts) contacts.push_back({&instant, &contact});
  }
  std::vector<TrajectoryFile> files = {
      {".csv",
       FormatCsv(ListInstantColumns(*trajectory.hand, trajectory.traced), trajectory.traced.trace)},
      {".contacts.csv", FormatCsv(ListTrajectoryContactColumns(*trajectory.hand), contacts)},
      {".events.csv", FormatCsv(ListTrajectoryEventColumns(), ListTrajectoryEvents(trajectory))}};
  if (!trajectory.hand->skin) return files;
  files.push_back({".taxels.csv", FormatTaxelForces(trajectory)});
  files.push_back({".elements.csv", FormatCsv(ListTaxelColumns(), ListTaxels(*trajectory.hand))});
  return files;
}

}  // namespace

Json MakeTrajectoryContactSchema(const Hand& hand) {
  return MakeTableSchema(ListTrajectoryContactColumns(hand), "");
}

Json MakeTrajectoryEventSchema() { return MakeTableSchema(ListTrajectoryEventColumns(), ""); }

Json MakeTrajectoryTaxelSchema() { return MakeTableSchema(ListTaxelColumns(), ""); }

TrajectoryForm MakeCsvTrajectoryForm() {
  return {"csv", "tables: instants, contacts, events; of tactile elements forces and places",
          &MakeCsvFiles, nullptr};
}

}  // namespace graspbench
