#include "datasets/records/trace_table.h"
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

std::vector<TrajectoryFile> MakeCsvFiles(const TrialTrajectory& trajectory) {
  std::vector<TrajectoryContact> contacts;
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (const HandContact& contact : instant.contacts) contacts.push_back({&instant, &contact});
  }
  return {
      {".csv", FormatCsv(ListTraceColumns(*trajectory.hand), trajectory.traced.trace)},
      {".contacts.csv", FormatCsv(ListTrajectoryContactColumns(*trajectory.hand), contacts)},
      {".events.csv", FormatCsv(ListTrajectoryEventColumns(), ListTrajectoryEvents(trajectory))}};
}

}  // namespace

Json MakeTrajectoryContactSchema(const Hand& hand) {
  return MakeTableSchema(ListTrajectoryContactColumns(hand), "");
}

Json MakeTrajectoryEventSchema() { return MakeTableSchema(ListTrajectoryEventColumns(), ""); }

TrajectoryForm MakeCsvTrajectoryForm() {
  return {"csv", "three tables: instants, contacts, events", &MakeCsvFiles, nullptr};
}

}  // namespace graspbench
