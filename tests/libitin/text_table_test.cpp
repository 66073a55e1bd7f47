#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/text_table.hpp>

#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using Rows = std::vector<std::vector<std::string>>;

struct Read {
  Rows rows;
  std::vector<std::uint64_t> lines;
  std::vector<std::string> warnings;
};

Read read(const std::string& text, TextTable::Blanks blanks = TextTable::Blanks::kInCells) {
  std::istringstream stream(text);
  TextTable table(stream, "t.csv", blanks);
  Read read;
  while (table.next()) {
    read.rows.emplace_back(table.cells().begin(), table.cells().end());
    read.lines.push_back(table.line());
  }
  read.warnings = table.warnings();
  return read;
}

/// Text of ASCII in UTF-16, with a byte order mark.
std::string utf16(const std::string& text, bool little, bool mark = true) {
  std::string bytes = !mark ? "" : little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) bytes += little ? std::string{c, '\0'} : std::string{'\0', c};
  return bytes;
}

const Rows kTwo{{"a", "b"}, {"1", "2"}};

TEST(TextTable, ReadsEverySeparatorAndEncoding) {
  for (const std::string& text :
       {std::string("a,b\n1,2\n"), std::string("a;b\r\n1;2"), std::string("a\tb\n1\t2\n"), std::string("a,b\r1,2\r"),
        std::string("\xEF\xBB\xBF a , b\n 1,2\n"), std::string("sep=;\r\na;b\r\n1;2\r\n"),
        std::string("\xEF\xBB\xBF\"SEP=|\"\na|b\n1|2\n"), utf16("a;b\r\n1;2\r\n", true), utf16("a;b\r\n1;2", false),
        utf16("a;b\n1;2\n", true, false), utf16("a;b\n1;2\n", false, false), utf16("sep=,\na,b\n1,2\n", true)})
    EXPECT_EQ(read(text).rows, kTwo) << text;
  EXPECT_EQ(read("  a   b\n1 \t2  \n", TextTable::Blanks::kBetweenCells).rows, kTwo);
  EXPECT_EQ(read("a b\n1 2\n").rows, (Rows{{"a b"}, {"1 2"}}));
}

TEST(TextTable, PassesOverLinesThatAreNoRowsAndNumbersLinesAsTheFileDoes) {
  const Read plain = read(",,,\n\n# made by hand\n \t\na,b\n;\n\"\",\n1,2\n\n# an end\n3,4\n");
  EXPECT_EQ(plain.rows, (Rows{{"a", "b"}, {"1", "2"}, {"3", "4"}}));
  EXPECT_EQ(plain.lines, (std::vector<std::uint64_t>{5, 8, 11}));
  EXPECT_TRUE(plain.warnings.empty());
  EXPECT_TRUE(read("").rows.empty());
  EXPECT_TRUE(read("sep=;\n").rows.empty());
}

TEST(TextTable, TellsOfRemarksThatLookLikeRows) {
  const Read one = read("a,b\n#1,2\n3,4\n");
  EXPECT_EQ(one.rows.size(), 2U);
  EXPECT_EQ(one.warnings,
            std::vector<std::string>{"t.csv: line 2 begins with # and is left out as a remark; if it is a "
                                     "row, write its first cell in quotes"});
  EXPECT_EQ(read("a,b\n\"#1\",2\n").rows[1], (std::vector<std::string>{"#1", "2"}));
  EXPECT_TRUE(read("a,b\n#1,2,3 \"open\n3,4\n").warnings.empty());
}

TEST(TextTable, TakesWhatQuotesHold) {
  EXPECT_EQ(read("\"a, b\" ,\"c \"\"d\"\"\"\n").rows, (Rows{{"a, b", "c \"d\""}}));
  EXPECT_EQ(read("51\xC2\xB0 32' 37\"N;3\xC2\xB0 17' 36\"W\n").rows,
            (Rows{{"51\xC2\xB0 32' 37\"N", "3\xC2\xB0 17' 36\"W"}}));
  const Read broken = read("name,\"Antenna\nHeight\"\r\n\"Garth\r\nmast\",2\nx,3\n");
  EXPECT_EQ(broken.rows, (Rows{{"name", "Antenna Height"}, {"Garth mast", "2"}, {"x", "3"}}));
  EXPECT_EQ(broken.lines, (std::vector<std::uint64_t>{1, 3, 5}));
  EXPECT_TRUE(broken.warnings.empty());
  try {
    read("a,b\n1,2\n\"open,3\n4,5\n");
    ADD_FAILURE() << "the quote is open";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 29), "t.csv: line 3: a quote is ope");
  }
}

TEST(TextTable, DecodesNamesThatAreNotUtf8) {
  const Read read_ = read("name,x\nCaf\xE9 \x80,1\nPlas \xC5\xB7,2\nTy\x01,3\nT\xFC,4\n");
  EXPECT_EQ(read_.rows[1][0], "Caf\xC3\xA9 \xE2\x82\xAC");
  EXPECT_EQ(read_.rows[2][0], "Plas \xC5\xB7");
  EXPECT_EQ(read_.rows[3][0], "Ty?");
  ASSERT_EQ(read_.warnings.size(), 2U);
  EXPECT_EQ(
      read_.warnings[0],
      "t.csv: line 2 and 1 other text: not written in UTF-8; read as Windows-1252, so check letters with accents");
  EXPECT_EQ(read_.warnings[1], "t.csv: line 4: control characters are shown as question marks");
}

TEST(TextTable, OfADirectoryOrNoFileIsAFileError) {
  EXPECT_THROW(TextTable("/nowhere/t.csv"), FileError);
  EXPECT_THROW(TextTable("/tmp").next(), FileError);
}

RC_GTEST_PROP(TextTable, AnyCellsComeBack, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  const std::string separators = ",;\t";
  const char separator = separators[random() % 3];
  const auto text = [&] {
    std::string cell = "c";
    for (auto left = random() % 6; left > 0; --left) cell += std::string("ab\",;# '")[random() % 8];
    return cell + "c";
  };
  const auto quoted = [](const std::string& cell) {
    std::string result = "\"";
    for (const char c : cell) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
  };
  Rows rows;
  std::string file;
  for (std::size_t row = 0, width = 2 + random() % 3; row < 1 + random() % 8; ++row) {
    rows.emplace_back();
    for (std::size_t i = 0; i < width; ++i) {
      rows.back().push_back(row == 0 ? "head" : text());
      const bool must = rows.back().back().find_first_of(",;") != std::string::npos;
      file += (i == 0 ? "" : std::string(1, separator)) +
              (must || random() % 2 ? quoted(rows.back().back()) : rows.back().back());
    }
    file += random() % 2 ? "\n" : "\r\n\r\n";
  }
  RC_ASSERT(read(file).rows == rows);
  RC_ASSERT(read(utf16(file, random() % 2)).rows == rows);
}

RC_GTEST_PROP(TextTable, AnyBytesAreReadOrRefused, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  constexpr std::string_view kAlphabet = "0a,;\t \r\n\"#\0\xff\xfe\xe9\xc3\xa9=";
  std::string file;
  for (auto left = random() % 60; left > 0; --left) file += kAlphabet[random() % kAlphabet.size()];
  try {
    for (const auto& row : read(file).rows)
      for (const std::string& cell : row) RC_ASSERT(is_plain_text(cell));
  } catch (const Error& error) {
    RC_ASSERT(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
}

TEST(Numbers, TakeADecimalCommaWhereItCanBeNoOther) {
  EXPECT_EQ(number_in("+1.5"), 1.5);
  EXPECT_EQ(number_in("51,54"), 51.54);
  EXPECT_EQ(number_in("0,125"), 0.125);
  EXPECT_EQ(number_in("-310375,125"), -310375.125);
  for (const char* text : {"318,000", "-1,000", "1,2,3", "1,5.2", "", ",", "+-1", "1 2", "x"})
    EXPECT_EQ(number_in(text), std::nullopt) << text;
}

}  // namespace
}  // namespace itin
