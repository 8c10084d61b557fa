#include "core/base/text/csv.h"
#include "datasets/records/trace_table.h"
#include "datasets/trajectory/trajectory_form.h"

namespace graspbench {
namespace {

struct ContactRow {
  const TraceInstant* instant;
  const HandContact* contact;
};

template <class Find>
void AddVectorColumns(const std::string& name, const std::string& unit, const std::string& of,
                      Find find, std::vector<CsvColumn<ContactRow>>& columns) {
  const std::string ending = unit.empty() ? "" : "_" + std::string(unit == "N" ? "n" : unit);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "xyz"[axis]);
    columns.push_back({name + "_" + letter + ending, unit, letter + " of " + of,
                       [find, axis](const ContactRow& row) { return find(*row.contact)[axis]; }});
  }
}

std::vector<CsvColumn<ContactRow>> ListTrajectoryContactColumns(const Hand& hand) {
  using Row = ContactRow;
  std::vector<CsvColumn<Row>> columns = {
      {"time_s", "s", "since the start of placing",
       [](const Row& row) { return row.instant->time; }},
      {"link", "", "link of the hand",
       [&hand](const Row& row) { return hand.links[static_cast<size_t>(row.contact->link)].name; }},
      {"digit", "string", "", "digit of that link; palm: none", [&hand](const Row& row) {
         const int digit = hand.FindDigitOfLink(row.contact->link);
         return Json(digit < 0 ? "palm" : hand.digits[static_cast<size_t>(digit)].id);
       }}};
  AddVectorColumns(
      "p", "m", "the contact in the world", [](const HandContact& c) { return c.p_WC; }, columns);
  AddVectorColumns(
      "n", "", "the unit normal from the hand into the object, in the world",
      [](const HandContact& c) { return c.nhat_W; }, columns);
  columns.push_back({"normal_force_n", "N", "of the hand on the object",
                     [](const Row& row) { return row.contact->normal_force; }});
  AddVectorColumns(
      "friction", "N", "the tangential force on the object, in the world",
      [](const HandContact& c) { return c.friction_W; }, columns);
  columns.push_back({"spin_moment_nm", "N m", "on the object about the normal",
                     [](const Row& row) { return row.contact->spin_moment; }});
  columns.push_back({"slip_speed_m_per_s", "m/s", "tangential speed of the surfaces",
                     [](const Row& row) { return row.contact->slip_speed; }});
  columns.push_back({"mu", "", "coefficient of friction in this state",
                     [](const Row& row) { return row.contact->mu; }});
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
  std::vector<ContactRow> contacts;
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (const HandContact& contact : instant.contacts) contacts.push_back({&instant, &contact});
  }
  return {
      {".csv", FormatCsv(ListTraceColumns(*trajectory.hand), trajectory.traced.trace)},
      {".contacts.csv", FormatCsv(ListTrajectoryContactColumns(*trajectory.hand), contacts)},
      {".events.csv", FormatCsv(ListTrajectoryEventColumns(), ListTrajectoryEvents(trajectory))}};
}

}  // namespace

TrajectoryForm MakeCsvTrajectoryForm() {
  return {"csv", "three tables: instants, contacts, events", &MakeCsvFiles, nullptr};
}

}  // namespace graspbench
