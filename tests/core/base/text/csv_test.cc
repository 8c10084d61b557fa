#include "core/base/text/csv.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

struct Row {
  std::string text;
  double number = 0.0;
};

std::vector<CsvColumn<Row>> ListColumns() {
  return {{"text", "string", "", "what it says", [](const Row& row) { return Json(row.text); }},
          {"number_s", "s", "how long", &Row::number},
          {"is_long", "", "above 1", [](const Row& row) { return row.number > 1.0; }}};
}

TEST(FormatCsv, QuotesOnlyWhatMustBeAndLeavesMissingEmpty) {
  const std::vector<Row> rows = {{"plain", 0.1}, {"a,b", 2.0}, {"say \"x\"\n", std::nan("")}};
  EXPECT_EQ(FormatCsv(ListColumns(), rows),
            "text,number_s,is_long\nplain,0.1,0\n\"a,b\",2.0,1\n\"say \"\"x\"\"\n\",,0\n");
}

TEST(FormatCsv, GuardsWhatASpreadsheetWouldRun) {
  const std::vector<Row> rows = {{"=1+1", -1.0}, {"@SUM(A1), x", -2.0}, {"\tgo", 0.0}};
  EXPECT_EQ(FormatCsv(ListColumns(), rows),
            "text,number_s,is_long\n'=1+1,-1.0,0\n\"'@SUM(A1), x\",-2.0,0\n\"'\tgo\",0.0,0\n");
  EXPECT_EQ(GuardCell("-12.5e3"), "-12.5e3") << "a number is no formula";
  EXPECT_EQ(GuardCell("-12.5e3x"), "'-12.5e3x");
  EXPECT_EQ(GuardCell("\uff1d1+1"), "'\uff1d1+1") << "a wide equals sign";
  EXPECT_EQ(GuardCell("-1,5"), "'-1,5") << "of no country that this file is written for";
}

TEST(ShowTable, ShowsTextToPeopleAsItIs) {
  std::vector<CsvColumn<Row>> columns = ListColumns();
  columns[0] = columns[0].Shown("text");
  const ShownTable table = ShowTable(columns, {{"FF 51 %, \"TH\" 49 %", 0.1}, {"=1+1", 0.2}});
  EXPECT_EQ(table.columns.at(0).cells, (std::vector<std::string>{"FF 51 %, \"TH\" 49 %", "=1+1"}));
}

/** The cells of a line as a spreadsheet sees them whose cells end at `separator`: a quote counts
where a cell begins, and nowhere else. */
std::vector<std::string> SplitAsSpreadsheet(const std::string& text, char separator) {
  std::vector<std::string> cells(1);
  bool is_quoted = false, is_begin = true;
  for (size_t i = 0; i < text.size(); ++i) {
    if (is_begin && text[i] == '"') {
      is_quoted = true;
    } else if (is_quoted && text[i] == '"') {
      is_quoted = text.substr(i + 1, 1) == "\"";
      if (is_quoted) cells.back() += text[++i];
    } else if (!is_quoted && (text[i] == separator || text[i] == '\n' || text[i] == '\r')) {
      cells.emplace_back();
      is_begin = true;
      continue;
    } else {
      cells.back() += text[i];
    }
    is_begin = false;
  }
  return cells;
}

TEST(FormatCsv, RunsNothingInSpreadsheetsOfAnyCountry) {
  const std::string letters = "=-'\";,\t\nx";
  for (const char a : letters) {
    for (const char b : letters) {
      for (const char c : letters) {
        for (const char d : letters) {
          const std::string text = {a, b, c, d};
          const std::string line = FormatCsvLine({"name", text, text, "end"});
          for (const char separator : {',', ';', '\t'}) {
            for (const std::string& cell : SplitAsSpreadsheet(line, separator)) {
              const std::string& bare =
                  cell.substr(std::min(cell.find_first_not_of('"'), cell.size()));
              EXPECT_TRUE(bare.empty() || (bare[0] != '=' && bare[0] != '-')) << text << "\n"
                                                                              << line;
            }
          }
          EXPECT_EQ(SplitAsSpreadsheet(line, ',').at(1), GuardCell(text)) << line;
          EXPECT_EQ(UnguardCell(GuardCell(text)), text);
        }
      }
    }
  }
}

TEST(GuardCell, IsUndoneForEveryText) {
  const std::string letters =
      "'=+-@\t\x7f\x01"
      "a1";
  for (const char a : letters) {
    for (const char b : letters) {
      for (const char c : letters) {
        const std::string text = {a, b, c};
        EXPECT_EQ(UnguardCell(GuardCell(text)), text);
        const char first = GuardCell(text)[0];
        const bool is_number = text[1] == '1' && text[2] == '1';
        EXPECT_TRUE(is_number || std::string("'a1").find(first) != std::string::npos) << text;
      }
    }
  }
  for (const char* text : {"", "'", "''", "it's", "'=", "''=", "=", "\xc2\xb5m"}) {
    EXPECT_EQ(UnguardCell(GuardCell(text)), text);
  }
}

TEST(MakeTableSchema, SaysWhatEachColumnIs) {
  const Json schema = MakeTableSchema(ListColumns(), "text");
  EXPECT_EQ(schema.at("primaryKey"), "text");
  EXPECT_EQ(schema.at("fields").at(1).at("unit"), "s");
  EXPECT_EQ(schema.at("fields").at(2).at("trueValues"), Json({"1"}));
  EXPECT_FALSE(schema.at("fields").at(0).contains("unit"));
  EXPECT_FALSE(MakeTableSchema(ListColumns(), "").contains("primaryKey"));
}

}  // namespace
}  // namespace graspbench
